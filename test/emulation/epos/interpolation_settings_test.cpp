#include <gtest/gtest.h>

#include "emulation/canopen/wire_host.h"
#include "trapezoid.h"

// Warning levels, and answers to what the documents leave open, at the wire. 2000 qc per turn: 600 rpm = 20
// qc/ms.
namespace interpolated_motion::emulation {
namespace {

constexpr unsigned kIpStatus = 0x20C4;

void start_trapezoid(WireHost& host) {
  host.prepare();
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
}

TEST(InterpolationSettings, WarningLevelsAreLimitsThatAreNotYetReached) {
  WireHost host(stiff());
  host.prepare();
  const auto status_with = [&host](int fill) {
    host.write(0x60C4, 6, 0, 1);
    host.write(0x60C4, 6, 1, 1);
    for (int i = 0; i < fill; ++i) host.record(0, 0, 10);
    host.run(ms(10));
    return host.read(kIpStatus, 1);
  };
  EXPECT_EQ(status_with(3), 0x4001U);
  EXPECT_EQ(status_with(4), 0x4000U);
  EXPECT_EQ(status_with(60), 0x4000U);
  EXPECT_EQ(status_with(61), 0x4002U);
  ASSERT_EQ(host.write(kIpStatus, 2, 10, 2), 0U);
  ASSERT_EQ(host.write(kIpStatus, 3, 12, 2), 0U);
  EXPECT_EQ(status_with(9), 0x4001U);
  EXPECT_EQ(status_with(12), 0x4000U);
  EXPECT_EQ(status_with(13), 0x4002U);
}

// From rest to rest over 100 qc in 10 ms the cubic has 1.5 * 10 qc/ms = 450 rpm in its middle and nothing at
// its ends.
TEST(InterpolationSettings, OvershootBetweenKnotsIsSeenAtSamplesOnly) {
  for (const auto check : {MotionCheck::Samples, MotionCheck::Knots}) {
    EposParameters parameters = stiff();
    parameters.motion_check = check;
    WireHost host(parameters);
    host.prepare();
    ASSERT_EQ(host.write(0x607F, 0, 449, 4), 0U);
    host.record(100, 0, 10);
    host.record(100, 0, 10);
    host.record(0, 0, 0);
    host.control(0x1F);
    host.run(ms(50));
    EXPECT_EQ(host.status(), check == MotionCheck::Samples ? 0x0308U : 0x0737U);
  }
}

TEST(InterpolationSettings, MotionWarningsMayBeLatched) {
  for (const bool latched : {true, false}) {
    EposParameters parameters = stiff();
    parameters.motion_warnings_latched = latched;
    WireHost host(parameters);
    host.prepare();
    ASSERT_EQ(host.write(0x6081, 0, 500, 4), 0U);
    host.record(600, 600, 60);
    host.record(1200, 0, 60);
    host.record(1200, 0, 100);
    host.record(0, 0, 0);
    host.control(0x1F);
    host.run(ms(61));
    EXPECT_EQ(host.read(kIpStatus, 1) & 4U, 4U);
    host.run(ms(100));
    EXPECT_EQ(host.read(kIpStatus, 1) & 4U, latched ? 4U : 0U);
  }
}

TEST(InterpolationSettings, ErrorBitsAreClearedAtTheSetMoment) {
  for (const auto moment : {ErrorBitsClear::AtFaultReset, ErrorBitsClear::AtBufferClear}) {
    EposParameters parameters = stiff();
    parameters.error_bits_clear = moment;
    WireHost host(parameters);
    host.prepare();
    host.control(0x1F);
    host.run(ms(5));
    EXPECT_EQ(host.read(kIpStatus, 1), 0x4101U);
    host.control(0x80);
    EXPECT_EQ(host.read(kIpStatus, 1), moment == ErrorBitsClear::AtFaultReset ? 0x4001U : 0x4101U);
    ASSERT_EQ(host.write(0x60C4, 6, 0, 1), 0U);
    EXPECT_EQ(host.read(kIpStatus, 1), 0x0000U);
  }
}

TEST(InterpolationSettings, ClearingBitFourInMotionStopsByTheSetting) {
  for (const auto stop : {ActiveStop::ProfileDeceleration, ActiveStop::AtOnce}) {
    EposParameters parameters = stiff();
    parameters.active_stop = stop;
    WireHost host(parameters);
    std::vector<double> demands;
    host.drive->set_sample_observer([&](const EposSample& s) { demands.push_back(s.demand); });
    start_trapezoid(host);
    ASSERT_EQ(host.write(0x6084, 0, 30000, 4), 0U);  // 1 qc/ms^2: 20 ms and 200 qc from 20 qc/ms
    host.run(ms(90));
    host.send(0x601, {0x2B, 0x40, 0x60, 0, 0x0F, 0, 0, 0});
    while (host.status() != 0x0737U) host.run(ms(1));
    // The last sample of the interpolation is the one before the steps of 20 qc end.
    std::size_t last = demands.size() - 1;
    while (demands[last] - demands[last - 1] < 20.0 - 1e-9) --last;
    EXPECT_NEAR(demands.back() - demands[last], stop == ActiveStop::AtOnce ? 0.0 : 200.0, 1e-6);
  }
}

// 0x605E: 0 at once, 1 profile deceleration, 2 quick-stop deceleration; 20 qc/ms at 1 and 2 qc/ms^2 take 200
// and 100 qc.
TEST(InterpolationSettings, FaultReactionFollowsItsOptionCode) {
  const double distance[] = {0.0, 200.0, 100.0};
  for (unsigned option = 0; option <= 2; ++option) {
    WireHost host(stiff());
    host.prepare();
    ASSERT_EQ(host.write(0x605E, 0, option, 2), 0U);
    ASSERT_EQ(host.write(0x6084, 0, 30000, 4), 0U);
    ASSERT_EQ(host.write(0x6085, 0, 60000, 4), 0U);
    host.record(600, 600, 60);
    host.record(2600, 600, 100);
    host.control(0x1F);
    host.run(ms(300));
    EXPECT_EQ(host.status(), 0x0308U);
    // The second record is alone when the first has been reached, at 600 qc; the sample after that is at 620.
    EXPECT_NEAR(host.drive->position(), 620.0 + distance[option], 0.51) << "option " << option;
  }
}

TEST(InterpolationSettings, FaultReactionShowsItsOwnStatusword) {
  WireHost host(stiff());
  start_trapezoid(host);
  ASSERT_EQ(host.write(0x6085, 0, 3000, 4), 0U);  // 0.1 qc/ms^2: 200 ms from 20 qc/ms
  host.run(ms(90));
  host.drive->raise_fault(0x1000, 0, host.world.now());
  EXPECT_EQ(host.status(), 0x031FU);
  host.run(ms(220));
  EXPECT_EQ(host.status(), 0x0308U);
}

TEST(InterpolationSettings, OverflowWhileInactiveFollowsItsSetting) {
  for (const auto setting : {InactiveOverflow::Fault, InactiveOverflow::ErrorBit, InactiveOverflow::Drop}) {
    EposParameters parameters = stiff();
    parameters.overflow_while_inactive = setting;
    WireHost host(parameters);
    host.prepare();
    for (int i = 0; i < 65; ++i) host.record(0, 0, 255);
    host.run(ms(20));
    EXPECT_EQ(host.count(0x081), setting == InactiveOverflow::Fault ? 1U : 0U);
    EXPECT_EQ(host.read(kIpStatus, 1), setting == InactiveOverflow::Drop ? 0x4002U : 0x4202U);
  }
}

// CiA 301, 7.2.7: one message for an error, and none as long as no new one occurs. The history keeps what was
// before.
TEST(InterpolationSettings, RecordsForAFullBufferAreOneError) {
  WireHost host(stiff());
  host.prepare();
  host.drive->send_emergency(0x4210, 0x08, host.world.now());
  for (int i = 0; i < 64 + 70; ++i) {
    host.record(0, 0, 255);
    host.run(ms(0.2));
  }
  EXPECT_EQ(host.count(0x081), 2U);
  EXPECT_EQ(host.read(0x1003, 0) & 0xFFU, 2U);
  EXPECT_EQ(host.read(0x1003, 1), 0xFF0CU);
  EXPECT_EQ(host.read(0x1003, 2), 0x4210U);
}

TEST(InterpolationSettings, PositionLimitFaultsWithItsOwnCode) {
  for (const auto check : {PositionLimitCheck::RunTime, PositionLimitCheck::PerRecord}) {
    EposParameters parameters = stiff();
    parameters.position_limit_check = check;
    WireHost host(parameters);
    host.prepare();
    ASSERT_EQ(host.write(0x607D, 2, 3000, 4), 0U);
    trapezoid(host);
    host.run(ms(3));
    EXPECT_EQ(host.count(0x081), check == PositionLimitCheck::PerRecord ? 1U : 0U);
    if (check == PositionLimitCheck::RunTime) host.record(0, 0, 0);
    host.control(0x1F);
    host.run(ms(400));
    const auto emergency = host.take(0x081);
    ASSERT_TRUE(emergency);
    EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x09, 0xFF, 0x81, 0, 0, 0, 0, 0}));
  }
}

TEST(InterpolationSettings, TooFewRecordsAtTheStartFollowTheirSetting) {
  for (const auto setting : {ShortStart::Fault, ShortStart::Ignore}) {
    EposParameters parameters = stiff();
    parameters.short_start = setting;
    WireHost host(parameters);
    host.prepare();
    host.record(10, 0, 10);
    host.control(0x1F);
    host.run(ms(5));
    EXPECT_EQ(host.status(), setting == ShortStart::Fault ? 0x0308U : 0x0737U);
    EXPECT_EQ(host.count(0x081), setting == ShortStart::Fault ? 1U : 0U);
  }
}

TEST(InterpolationSettings, LeadingTerminatorFollowsItsSetting) {
  for (const auto setting :
       {LeadingTerminator::EndsMode, LeadingTerminator::Skipped, LeadingTerminator::Fault}) {
    EposParameters parameters = stiff();
    parameters.leading_terminator = setting;
    WireHost host(parameters);
    host.prepare();
    host.record(0, 0, 0);
    host.record(10, 0, 100);
    host.record(20, 0, 100);
    host.control(0x1F);
    host.run(ms(5));
    const std::uint32_t expected[] = {0x0737, 0x1337, 0x0308};
    EXPECT_EQ(host.status(), expected[static_cast<int>(setting)]);
  }
}

TEST(InterpolationSettings, UnderflowTestAtEverySampleStopsEarlier) {
  for (const auto setting : {UnderflowTest::AtSegmentEnd, UnderflowTest::EverySample}) {
    EposParameters parameters = stiff();
    parameters.underflow_test = setting;
    WireHost host(parameters);
    Watched watched(*host.drive);
    host.prepare();
    host.record(0, 0, 50);
    host.record(0, 0, 50);
    host.control(0x1F);
    host.run(ms(200));
    EXPECT_EQ(watched.samples.back().samples_since_start, setting == UnderflowTest::AtSegmentEnd ? 100 : 51);
    EXPECT_EQ(host.count(0x081), 1U);
  }
}

TEST(InterpolationSettings, RecordLeavesTheBufferAtTheSetMoment) {
  for (const auto setting : {RecordRelease::AtSegmentEnd, RecordRelease::AtSegmentStart}) {
    EposParameters parameters = stiff();
    parameters.record_release = setting;
    WireHost host(parameters);
    host.prepare();
    for (int i = 0; i < 5; ++i) host.record(0, 0, 200);
    host.control(0x1F);
    host.run(ms(5));
    EXPECT_EQ(host.read(0x60C4, 4), setting == RecordRelease::AtSegmentEnd ? 5U : 4U);
    host.run(ms(200));
    EXPECT_EQ(host.read(0x60C4, 4), setting == RecordRelease::AtSegmentEnd ? 4U : 3U);
  }
}

TEST(InterpolationSettings, RecordsAtAWrongMomentFollowTheirSetting) {
  EposParameters parameters = stiff();
  parameters.records_while_access_disabled = RecordPolicy::Abort;
  parameters.records_outside_mode = RecordPolicy::Drop;
  WireHost host(parameters);
  host.boot();
  const auto segmented = [&host] {
    EXPECT_EQ(host.exchange({0x21, 0xC1, 0x20, 0, 8, 0, 0, 0})[0], 0x60);
    EXPECT_EQ(host.exchange({0x00, 1, 0, 0, 0, 0, 0, 0})[0], 0x20);
    return WireHost::result(host.exchange({0x1D, 10, 0, 0, 0, 0, 0, 0}), 0x30);
  };
  EXPECT_EQ(segmented(), 0x08000022U);
  ASSERT_EQ(host.write(0x60C4, 6, 1, 1), 0U);
  EXPECT_EQ(segmented(), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 0U);
  ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  EXPECT_EQ(segmented(), 0U);
  EXPECT_EQ(host.read(0x60C4, 4), 1U);
}

TEST(InterpolationSettings, HaltMayRequireANewStart) {
  EposParameters parameters = stiff();
  parameters.halt_release = HaltRelease::NeedsNewStart;
  WireHost host(parameters);
  host.prepare();
  trapezoid(host);
  host.record(0, 0, 0);
  host.control(0x1F);
  host.run(ms(100));
  host.control(0x11F);
  host.run(ms(100));
  host.control(0x1F);
  host.run(ms(10));
  EXPECT_EQ(host.status(), 0x0737U);
  host.control(0x0F);
  host.control(0x1F);
  host.run(ms(5));
  EXPECT_EQ(host.status(), 0x1337U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
