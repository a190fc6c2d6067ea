#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wire_host.h"

// Clock discipline of EPOS2 by SYNC and 0x1013, at the wire: when the drive's 1 ms samples come in true time.
namespace interpolated_motion::emulation {
namespace {

constexpr std::uint32_t kTimeStampId = 0x47F;

EposParameters with_clock(double ppm) {
  EposParameters parameters;
  parameters.clock_error_ppm = ppm;
  return parameters;
}

/// A master that sends SYNC each 10 ms and, in an RPDO, the time at which that SYNC ended on the bus, on a
/// clock that reads `clock_at_start` at the start.
struct Disciplined {
  WireHost host;
  std::uint32_t clock_at_start = 0;
  std::vector<HostTime> samples;

  explicit Disciplined(const EposParameters& parameters) : host(parameters) {
    host.boot();
    set_up();
    host.nmt(1);
    host.drive->set_sample_observer([this](const EposSample& s) { samples.push_back(s.time); });
  }

  void set_up() {
    ASSERT_EQ(host.write(0x1402, 1, 0x80000000U | kTimeStampId, 4), 0U);
    ASSERT_EQ(host.write(0x1402, 2, 255, 1), 0U);
    ASSERT_EQ(host.write(0x1602, 0, 0, 1), 0U);
    ASSERT_EQ(host.write(0x1602, 1, 0x10130020, 4), 0U);
    ASSERT_EQ(host.write(0x1602, 0, 1, 1), 0U);
    ASSERT_EQ(host.write(0x1402, 1, kTimeStampId, 4), 0U);
  }

  /// SYNC without data takes 48 bits to its end: 48 us at 1 Mbit/s.
  std::uint32_t sync() {
    const HostTime end = host.world.now() + std::chrono::microseconds(48);
    host.send(0x080, {});
    host.run(ms(1));
    return clock_at_start + static_cast<std::uint32_t>(end.time_since_epoch() / std::chrono::microseconds(1));
  }

  void time_stamp(std::uint32_t us) {
    host.send(kTimeStampId, {us & 0xFF, us >> 8 & 0xFF, us >> 16 & 0xFF, us >> 24});
  }

  void cycle(bool stamped = true, std::uint32_t add = 0) {
    const std::uint32_t time = sync();
    if (stamped) time_stamp(time + add);
    host.run(ms(9));
  }

  void cycles(int count, bool stamped = true, std::uint32_t add = 0) {
    for (int i = 0; i < count; ++i) cycle(stamped, add);
  }

  /// By how much sample `k` after sample `first` is early (> 0) against whole milliseconds of true time, us.
  double early(std::size_t first, std::size_t k) const {
    return 1e3 * static_cast<double>(k) - 1e6 * seconds(samples[first + k] - samples[first]);
  }

  /// The samples from `first` on: how far the most deviating is from 1 ms after its predecessor, us.
  double worst_step(std::size_t first) const {
    double worst = 0.0;
    for (std::size_t i = std::max<std::size_t>(first, 1); i < samples.size(); ++i) {
      worst = std::max(worst, std::abs(1e6 * seconds(samples[i] - samples[i - 1]) - 1e3));
    }
    return worst;
  }
};

TEST(MotionClock, FollowsTheMasterWhateverItsCrystal) {
  for (const double ppm : {-200.0, -100.0, 0.0, 37.0, 100.0, 200.0}) {
    SCOPED_TRACE(ppm);
    Disciplined drive(with_clock(ppm));
    drive.cycles(3000);
    // One cycle's drift, twice 1 us of resolution, and what a crystal gains from SYNC to the correction.
    const double bound = 0.01 * std::abs(ppm) + 2.0 + 0.01 * std::abs(ppm);
    for (std::size_t k = 100; k + 100 < drive.samples.size(); k += 17) {
      ASSERT_NEAR(drive.early(100, k), 0.0, bound) << "sample " << k;
    }
    EXPECT_NEAR(static_cast<double>(drive.samples.size()), 30000.0, 1.0) << "1 per ms";
    EXPECT_LE(drive.worst_step(0), 1.0 + 1e-3 * std::abs(ppm) + 0.002) << "clock_slew and the crystal";
  }
}

// "EPOS2 Interpolated Position Mode", 2008: TIME (0x100) sets the motion clock to zero, on which the master's
// time stamps go on. A first stamp that is 50 us beside it is made good, since the clock's zero is known.
TEST(MotionClock, TimeSetsItToZero) {
  for (const int beside : {0, 50}) {
    SCOPED_TRACE(beside);
    Disciplined drive(with_clock(0.0));
    drive.clock_at_start = 123456;
    drive.cycles(300);
    const std::size_t before = drive.samples.size() - 100;
    drive.host.send(0x100, {0, 0, 0, 0, 0, 0});
    drive.host.run(ms(1));
    // TIME with 6 bytes takes some 100 bits to its end, 1 ms less than now.
    drive.clock_at_start =
        0U - static_cast<std::uint32_t>((drive.host.world.now() - ms(0.9)).time_since_epoch() /
                                        std::chrono::microseconds(1));
    drive.cycles(300, true, static_cast<std::uint32_t>(beside));
    EXPECT_NEAR(drive.early(before, 3000), beside, 25.0);
  }
}

TEST(MotionClock, WithoutTimeStampsTheCrystalRuns) {
  Disciplined drive(with_clock(100.0));
  drive.cycles(3000, false);
  // 100 ppm of the time up to that sample, which is k ms less those 100 ppm.
  EXPECT_NEAR(drive.early(0, 30000 - 10), 2999.0 * (1.0 - 1e-4), 0.01);
}

TEST(MotionClock, NorIsItChangedWhereTheDriveIgnoresThem) {
  EposParameters parameters = with_clock(-100.0);
  parameters.clock_discipline = false;
  Disciplined drive(parameters);
  drive.cycles(3000);
  EXPECT_NEAR(drive.early(0, 29990), -2999.0 * (1.0 + 1e-4), 0.01);
}

// A master that has been up for 71 min 34 s when the drives start: 2^32 us are over a second later.
TEST(MotionClock, FirstTimeStampSetsTheReferenceAndTheCountWrapsAround) {
  Disciplined drive(with_clock(0.0));
  drive.clock_at_start = 0xFFFFFFFFU - 1'300'000U;
  drive.cycles(300);
  ASSERT_GT(drive.samples.back(), HostTime{} + ms(3000));
  EXPECT_LE(drive.worst_step(0), 1.0);
  for (std::size_t k = 0; k < drive.samples.size(); ++k) ASSERT_NEAR(drive.early(0, k), 0.0, 2.0) << k;
}

// After 2 s without time stamps a slow drive is 200 us behind, and the next time stamp is 100 us past the
// turn: the drive's own count is still before it.
TEST(MotionClock, ADifferenceAcrossTheTurnOfTheCountIsSmall) {
  Disciplined drive(with_clock(-100.0));
  const auto now = drive.host.world.now().time_since_epoch() / std::chrono::microseconds(1);
  drive.clock_at_start = static_cast<std::uint32_t>(100 - (now + 2'050'000 + 48));
  drive.cycles(5);
  const std::size_t first = drive.samples.size() - 1;
  drive.cycles(200, false);
  EXPECT_NEAR(drive.early(first, 1990), -199.0, 5.0);
  const auto last_early = [&] { return drive.early(first, drive.samples.size() - 1 - first); };
  const double before = last_early();
  ASSERT_EQ(drive.sync(), 100U);
  drive.time_stamp(100);
  drive.host.run(ms(9));
  EXPECT_GT(last_early() - before, 5.0) << "1 us for each sample, in the right direction";
  drive.cycles(40);
  EXPECT_NEAR(last_early(), 0.0, 5.0);
}

// The master's clock is 300 us ahead from one time stamp to the next.
TEST(MotionClock, ADifferenceIsMadeUpInSmallSteps) {
  EposParameters parameters;
  parameters.clock_slew = std::chrono::microseconds(2);
  Disciplined drive(parameters);
  drive.cycles(10);
  const std::size_t first = drive.samples.size() - 1;
  drive.cycles(50, true, 300);
  EXPECT_NEAR(drive.early(first, 100), 200.0, 10.0)
      << "2 us at each of 100 samples, but for some of the first";
  EXPECT_NEAR(drive.early(first, 200), 300.0, 2.0);
  EXPECT_NEAR(drive.early(first, 490), 300.0, 2.0) << "no further";
  EXPECT_NEAR(drive.worst_step(1), 2.0, 1e-6);
}

TEST(MotionClock, LostSyncsAndTimeStampsAreSurvived) {
  Disciplined drive(with_clock(100.0));
  drive.cycles(100);
  const std::size_t first = drive.samples.size() - 1;
  drive.cycles(200, false);  // time stamps lost for 2 s: 200 us at 100 ppm
  EXPECT_NEAR(drive.early(first, 1990), 199.0, 5.0);
  drive.cycles(50);
  EXPECT_NEAR(drive.early(first, drive.samples.size() - 1 - first), 0.0, 5.0) << "and made up in 0.2 s";
  // A SYNC lost for the drive: the time stamp behind it belongs to no latched value.
  const std::uint32_t time = drive.sync();
  drive.time_stamp(time);
  drive.host.run(ms(9));
  drive.time_stamp(time + 10'000);
  drive.host.run(ms(10));
  EXPECT_NEAR(drive.early(first, drive.samples.size() - 1 - first), 0.0, 5.0);
}

TEST(MotionClock, EnteringOperationalForgetsTheReference) {
  Disciplined drive(with_clock(0.0));
  drive.cycles(10);
  const std::size_t first = drive.samples.size() - 1;
  drive.host.nmt(128);
  drive.clock_at_start += 123'456'789;  // another master
  drive.host.nmt(1);
  drive.cycles(100);
  EXPECT_NEAR(drive.early(first, drive.samples.size() - 1 - first), 0.0, 2.0);
}

TEST(MotionClock, TimeStampsComeBySdoAsWell) {
  Disciplined drive(with_clock(100.0));
  for (int i = 0; i < 300; ++i) {
    const std::uint32_t time = drive.sync();
    ASSERT_EQ(drive.host.write(0x1013, 0, time, 4), 0U);
    drive.host.run(ms(8));
  }
  EXPECT_NEAR(drive.early(100, drive.samples.size() - 101), 0.0, 5.0);
}

TEST(MotionClock, TimeStampMayBeMappedUnlessTheSettingDeniesIt) {
  EposParameters parameters;
  parameters.time_stamp_pdo_mappable = false;
  WireHost strict(parameters);
  strict.boot();
  ASSERT_EQ(strict.write(0x1402, 1, 0x8000047F, 4), 0U);
  ASSERT_EQ(strict.write(0x1602, 0, 0, 1), 0U);
  EXPECT_EQ(strict.write(0x1602, 1, 0x10130020, 4), 0x06040041U);
}

TEST(MotionClock, SlewMustLeaveTheSamplesInOrder) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  for (const auto slew : {std::chrono::nanoseconds(0), std::chrono::nanoseconds(500'001)}) {
    EposParameters parameters;
    parameters.clock_slew = slew;
    EXPECT_THROW(world.add<EposDrive>(bus, parameters), std::invalid_argument) << slew.count();
  }
}

}  // namespace
}  // namespace interpolated_motion::emulation
