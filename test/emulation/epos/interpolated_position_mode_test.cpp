#include <gtest/gtest.h>

#include <cmath>

#include "emulation/canopen/wire_host.h"
#include "trapezoid.h"

// The typical command sequence of "EPOS2 Interpolated Position Mode" at the wire. 2000 qc per turn: 600 rpm =
// 20 qc/ms, 10000 rpm/s = 1/3 qc/ms^2.
namespace interpolated_motion::emulation {
namespace {

constexpr unsigned kIpStatus = 0x20C4;

// Position of that profile by the school formulas of constant acceleration.
double trapezoid_at(double t) {
  if (t <= 60) return t * t / 6.0;
  if (t <= 160) return 600 + 20 * (t - 60);
  const double left = 220 - t;
  return 3200 - left * left / 6.0;
}

TEST(InterpolatedPositionMode, TypicalSequenceFollowsTheProfileAtEverySample) {
  WireHost host;
  Watched watched(*host.drive);
  host.prepare();
  EXPECT_EQ(host.read(0x6061, 0), 7U);
  EXPECT_EQ(host.status(), 0x0737U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4001U);
  trapezoid(host);
  host.record(3200, 0, 0);
  host.run(ms(2));
  EXPECT_EQ(host.read(0x60C4, 4), 4U);
  EXPECT_EQ(host.read(0x60C4, 2), 60U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4000U);
  host.control(0x1F);
  host.run(ms(5));
  EXPECT_EQ(host.status(), 0x1337U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0xC000U) << "60 ms at exactly 10000 rpm/s do not exceed 0x6083";
  host.run(ms(230));
  EXPECT_EQ(host.status(), 0x0737U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4001U);
  EXPECT_EQ(host.read(0x6062, 0), 3200U);
  EXPECT_EQ(host.read(0x6064, 0), 3200U);
  EXPECT_EQ(host.read(0x60C4, 4), 0U);
  EXPECT_EQ(host.count(0x081), 0U) << "no emergency";
  ASSERT_EQ(watched.samples.size(), 221U);
  for (std::size_t k = 0; k < watched.samples.size(); ++k) {
    EXPECT_EQ(watched.samples[k].samples_since_start, static_cast<std::int64_t>(k));
    EXPECT_NEAR(watched.samples[k].demand, trapezoid_at(static_cast<double>(k)), 1e-9) << "sample " << k;
  }
}

TEST(InterpolatedPositionMode, SamplesAreOneMillisecondOfTheDrivesOwnClockApart) {
  EposParameters parameters = stiff();
  parameters.clock_error_ppm = 1000.0;  // a fast crystal: 220 samples take 219.78 ms
  WireHost host(parameters);
  Watched watched(*host.drive);
  host.prepare();
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(300));
  ASSERT_EQ(watched.samples.size(), 221U);
  const double length = seconds(watched.samples.back().time - watched.samples.front().time);
  EXPECT_NEAR(length, 0.220 / 1.001, 2e-9);
}

TEST(InterpolatedPositionMode, ActualPositionLagsByTheSetTime) {
  EposParameters parameters;
  parameters.plant.lag_ms = 3.0;
  WireHost host(parameters);
  Watched watched(*host.drive);
  host.prepare();
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(300));
  // 20 qc/ms for 100 ms: the transient e^(-2/3 t) is gone at its end.
  EXPECT_NEAR(watched.samples[155].demand - watched.samples[155].actual, 60.0, 0.51);
  EXPECT_EQ(host.drive->position(), 3200);
}

TEST(InterpolatedPositionMode, NegativePositionAndVelocityAreSigned) {
  EposParameters parameters = stiff();
  parameters.initial_position = -1000;
  WireHost host(parameters);
  Watched watched(*host.drive);
  host.prepare();
  host.record(-1600, -600, 60);
  host.record(-2200, 0, 60);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(200));
  ASSERT_EQ(watched.samples.size(), 121U);
  EXPECT_NEAR(watched.samples[30].demand, -1150.0, 1e-9);
  EXPECT_NEAR(watched.samples[90].demand, -2050.0, 1e-9);
  EXPECT_EQ(static_cast<std::int32_t>(host.read(0x6064, 0)), -2200);
}

TEST(InterpolatedPositionMode, VelocityUnitFollowsTheNotationIndex) {
  WireHost host(stiff());
  Watched watched(*host.drive);
  host.prepare();
  ASSERT_EQ(host.write(0x608B, 0, -2, 1), 0U);
  ASSERT_EQ(host.write(0x6081, 0, 100000, 4), 0U);
  host.record(600, 60000, 60);  // 600.00 rpm
  host.record(1200, 0, 60);
  host.record(0, 0, 0);
  ASSERT_EQ(host.write(0x607F, 0, 25000, 4), 0U);  // now 250.00 rpm
  host.control(0x1F);
  host.run(ms(200));
  EXPECT_EQ(host.count(0x081), 1U) << "607F scales with the notation";
  EXPECT_EQ(host.read(kIpStatus, 1) & 0x0F00U, 0x0400U);
  EXPECT_EQ(host.write(0x608B, 0, -4, 1), 0x06090032U);
  EXPECT_EQ(host.write(0x608B, 0, 1, 1), 0x06090031U);
  // 250 rpm = 25/3 qc/ms is passed after 25 ms at 1/3 qc/ms^2.
  EXPECT_EQ(watched.samples.back().samples_since_start, 26);
  EXPECT_NEAR(watched.samples[20].demand, 400.0 / 6.0, 1e-9);
}

TEST(InterpolatedPositionMode, UnderflowIsAFaultWithQuickStopRamp) {
  WireHost host(stiff());
  host.prepare();
  ASSERT_EQ(host.write(0x6085, 0, 30000, 4), 0U);  // 1 qc/ms^2
  trapezoid(host);
  host.control(0x1F);
  host.run(ms(150));
  EXPECT_EQ(host.count(0x081), 0U);
  host.run(ms(150));
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x0C, 0xFF, 0x21, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.status(), 0x0308U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4101U);
  EXPECT_EQ(host.read(0x1001, 0), 0x21U);
  EXPECT_EQ(host.read(0x1003, 0), 1U);
  EXPECT_EQ(host.read(0x1003, 1), 0xFF0CU);
  EXPECT_EQ(host.drive->counters().underflows, 1U);
  EXPECT_EQ(host.drive->counters().minimum_fill, 1);

  host.control(0x00);
  host.control(0x80);
  const auto cleared = host.take(0x081);
  ASSERT_TRUE(cleared);
  EXPECT_EQ(bytes_of(cleared->frame), (Bytes{0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.status(), 0x0340U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4001U);
  EXPECT_EQ(host.read(0x1001, 0), 0U);
  host.control(0x00);
  host.control(0x80);
  EXPECT_EQ(host.status(), 0x0340U) << "a reset without a fault does nothing";
}

// "At least two data records have to be in the FIFO": with 600 qc reached one is left, and at the next
// sample, at 620, the drive brakes.
TEST(InterpolatedPositionMode, UnderflowInMotionStopsOnTheRamp) {
  WireHost host(stiff());
  host.prepare();
  ASSERT_EQ(host.write(0x6085, 0, 30000, 4), 0U);  // 1 qc/ms^2: from 20 qc/ms in 20 ms and 200 qc
  host.record(600, 600, 60);
  host.record(2600, 600, 100);
  host.control(0x1F);
  host.run(ms(300));
  EXPECT_EQ(host.count(0x081), 1U);
  EXPECT_EQ(host.drive->position(), 820);
  EXPECT_EQ(host.status(), 0x0308U);
}

// Three records and none that ends the mode: the third is not played to its end, at 3200.
TEST(InterpolatedPositionMode, OneRecordAloneIsAnUnderflow) {
  WireHost host(stiff());
  host.prepare();
  ASSERT_EQ(host.write(0x6085, 0, 30000, 4), 0U);
  trapezoid(host);
  host.control(0x1F);
  host.run(ms(150));
  EXPECT_EQ(host.count(0x081), 0U);
  host.run(ms(100));
  EXPECT_EQ(host.count(0x081), 1U);
  // After 1 ms of the third record: 2600 + 20 - 1/6 qc at 20 - 1/3 qc/ms, and (19 2/3)^2 / 2 to brake.
  EXPECT_NEAR(host.drive->position(), 2619.8 + 193.4, 1.0);
}

TEST(InterpolatedPositionMode, OverflowWhileActiveIsAFault) {
  WireHost host(stiff());
  host.prepare();
  for (int i = 0; i < 64; ++i) host.record(0, 0, 255);
  host.run(ms(20));
  EXPECT_EQ(host.read(0x60C4, 4), 64U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4002U);
  host.control(0x1F);
  host.run(ms(2));
  host.record(0, 0, 255);
  host.run(ms(5));
  EXPECT_EQ(host.count(0x081), 1U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x4202U);
  EXPECT_EQ(host.status(), 0x0308U);
  EXPECT_EQ(host.drive->counters().records_accepted, 64U);
  EXPECT_EQ(host.drive->counters().records_refused, 1U);
}

TEST(InterpolatedPositionMode, LimitsWarnAndFault) {
  struct Case {
    unsigned index, value, bits;
    bool fault;
  };
  // The trapezoid has 600 rpm and 10000 rpm/s.
  for (const Case& c :
       {Case{0x6081, 599, 0x0004, false}, Case{0x6083, 9999, 0x0008, false}, Case{0x607F, 599, 0x0400, true},
        Case{0x60C5, 9999, 0x0800, true}, Case{0x607F, 600, 0, false}, Case{0x60C5, 10000, 0, false}}) {
    SCOPED_TRACE(testing::Message() << std::hex << c.index << " := " << std::dec << c.value);
    WireHost host(stiff());
    host.prepare();
    ASSERT_EQ(host.write(c.index, 0, c.value, 4), 0U);
    trapezoid(host);
    host.record(0, 0, 0);
    host.control(0x1F);
    host.run(ms(400));
    EXPECT_EQ(host.read(kIpStatus, 1) & 0x0F0CU, c.bits);
    EXPECT_EQ(host.status(), c.fault ? 0x0308U : 0x0737U);
    EXPECT_EQ(host.count(0x081), c.fault ? 1U : 0U);
  }
}

TEST(InterpolatedPositionMode, SelectingTheModeAndClearingEmptyTheBuffer) {
  WireHost host(stiff());
  host.prepare();
  trapezoid(host);
  host.run(ms(2));
  ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 3U) << "the mode was selected already";
  ASSERT_EQ(host.write(0x60C4, 4, 0, 2), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 3U) << "writing the buffer position has no effect";
  ASSERT_EQ(host.write(0x6060, 0, 1, 1), 0U);
  ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 0U);
  trapezoid(host);
  host.run(ms(2));
  ASSERT_EQ(host.write(0x60C4, 6, 0, 1), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 0U);
  EXPECT_EQ(host.read(kIpStatus, 1), 0x0000U);
}

TEST(InterpolatedPositionMode, HaltStopsWithProfileDecelerationAndKeepsTheRecords) {
  WireHost host(stiff());
  Watched watched(*host.drive);
  host.prepare();
  ASSERT_EQ(host.write(0x6084, 0, 30000, 4), 0U);  // 1 qc/ms^2
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  while (watched.samples.empty() || watched.samples.back().samples_since_start < 100) host.run(ms(1));
  host.send(0x601, {0x2B, 0x40, 0x60, 0, 0x1F, 0x01, 0, 0});
  host.run(ms(100));
  const auto halted = static_cast<double>(watched.samples.back().samples_since_start);
  EXPECT_EQ(host.drive->position(), std::lround(trapezoid_at(halted) + 200.0));
  EXPECT_EQ(host.status(), 0x1737U) << "halt: bit 10 says that the axis stands";
  EXPECT_EQ(host.read(0x60C4, 4), 3U);
  EXPECT_EQ(host.count(0x081), 0U);
  host.control(0x1F);
  host.run(ms(200));
  EXPECT_EQ(host.status(), 0x0737U);
  EXPECT_EQ(host.drive->position(), 3200);
}

TEST(InterpolatedPositionMode, ClearingBitFourEndsTheModeWithoutAnError) {
  WireHost host(stiff());
  host.prepare();
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(80));
  host.control(0x0F);
  EXPECT_EQ(host.read(kIpStatus, 1) & 0x8F00U, 0U);
  host.run(ms(100));
  EXPECT_EQ(host.status(), 0x0737U);
  EXPECT_EQ(host.count(0x081), 0U);
}

TEST(InterpolatedPositionMode, SynchronousControlwordsStartDrivesTogether) {
  WireHost host(stiff());
  EposParameters second = stiff();
  second.node_id = 2;
  Watched a(*host.drive);
  Watched b(host.world.add<EposDrive>(host.bus, second));
  for (host.node = 1; host.node <= 2; ++host.node) {
    host.prepare();
    host.nmt(128);
    const unsigned low = host.node;
    ASSERT_EQ(host.write(0x1401, 1, 0x80000300 + low, 4), 0U);
    ASSERT_EQ(host.write(0x1401, 2, 1, 1), 0U);
    ASSERT_EQ(host.write(0x1601, 0, 0, 1), 0U);
    ASSERT_EQ(host.write(0x1601, 1, 0x60400010, 4), 0U);
    ASSERT_EQ(host.write(0x1601, 2, 0x60600008, 4), 0U);
    ASSERT_EQ(host.write(0x1601, 0, 2, 1), 0U);
    ASSERT_EQ(host.write(0x1401, 1, 0x300 + low, 4), 0U);
    host.nmt(1);
    trapezoid(host);
    host.record(0, 0, 0);
    host.send(0x300 + low, {0x1F, 0x00, 7});
    host.run(ms(10));
  }
  EXPECT_TRUE(a.samples.empty());
  EXPECT_TRUE(b.samples.empty());
  host.send(0x080, {});
  host.run(ms(300));
  ASSERT_EQ(a.samples.size(), 221U);
  ASSERT_EQ(b.samples.size(), 221U);
  EXPECT_LT(std::abs(seconds(a.samples[0].time - b.samples[0].time)), 0.001 + 1e-12);
}

TEST(InterpolatedPositionMode, StalledAxisFaultsWithFollowingError) {
  WireHost host;
  host.prepare();
  host.drive->stall(true);
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(400));
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x11, 0x86, 0x81, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.status(), 0x0308U);
  EXPECT_EQ(host.drive->position(), 0);
}

TEST(InterpolatedPositionMode, Epos4VariantHasNone) {
  EposParameters parameters;
  parameters.variant = EposVariant::Epos4;
  WireHost host(parameters);
  host.boot();
  for (const unsigned index : {0x20C1U, 0x20C4U, 0x60C0U, 0x60C4U}) {
    EXPECT_EQ(host.read_abort(index, 0), 0x06020000U) << std::hex << index;
  }
  EXPECT_EQ(host.write(0x6060, 0, 7, 1), 0x06090030U);
  EXPECT_EQ(host.read(0x6502, 0) & 0x40U, 0U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
