#include "interpolated_motion_driver/axis/playback_clock.h"

#include <cmath>

#include <gtest/gtest.h>

namespace interpolated_motion::axis {
namespace {

HostTime at(double s) { return HostTime{} + host_duration(s); }

TEST(PlaybackClock, StandsAtZeroUntilItIsStarted) {
  PlaybackClock clock;
  EXPECT_DOUBLE_EQ(clock.elapsed(at(5.0)), 0.0);
  clock.start(at(10.0));
  EXPECT_DOUBLE_EQ(clock.elapsed(at(9.0)), 0.0);
  EXPECT_DOUBLE_EQ(clock.elapsed(at(12.5)), 2.5);
}

TEST(PlaybackClock, ErrorIsUnknownUntilSomethingIsSeenAndThenThatOfTheLastMotion) {
  PlaybackClock clock(1e-3, 1e-3);
  EXPECT_TRUE(std::isnan(clock.error_ppm()));
  clock.start(at(0.0));
  EXPECT_TRUE(std::isnan(clock.error_ppm()));
  clock.observe_at_least(at(100.0), 100.05);
  const double seen = clock.error_ppm();
  EXPECT_NEAR(seen, 490.0, 1.0);
  clock.stop();
  EXPECT_EQ(clock.error_ppm(), seen);
  clock.start(at(200.0), true);
  EXPECT_EQ(clock.error_ppm(), 0.0);
}

TEST(PlaybackClock, BoundsAreThoseOfTheCrystalUntilSomethingIsSeen) {
  PlaybackClock clock(1e-3, 1e-3);
  clock.start(at(0.0));
  EXPECT_NEAR(clock.least_elapsed(at(100.0)), 100.0 - 0.1 - 0.001, 1e-9);
  EXPECT_NEAR(clock.most_elapsed(at(100.0)), 100.0 + 0.1 + 0.001, 1e-9);
}

// A drive 100 ppm fast passes a knot each 0.1 s of its own time; it is looked at each 10 ms.
TEST(PlaybackClock, FindsTheRateOfADriveFromItsFifo) {
  for (const double ppm : {-200.0, -100.0, 0.0, 35.0, 100.0}) {
    PlaybackClock clock(5e-4, 1e-3);
    clock.start(at(0.0));
    const double rate = 1.0 + ppm * 1e-6;
    for (int look = 1; look <= 60000; ++look) {
      const double host = 0.01 * look;
      const double passed = std::floor(host * rate / 0.1) * 0.1;
      clock.observe_at_least(at(host), passed);
      clock.observe_less_than(at(host), passed + 0.1);
      ASSERT_NEAR(clock.elapsed(at(host)), host * rate, 0.011 + 0.001) << ppm << " ppm at " << host << " s";
    }
    EXPECT_NEAR(clock.error_ppm(), ppm, 20.0);
  }
}

// Looks that are told to 0.3 ms, a start known to 0.15 ms: the bounds lie alike on both sides of the drive's
// true rate, so their middle is far nearer to it than their ends.
TEST(PlaybackClock, MiddleOfCloseBoundsIsTheTruth) {
  for (const double ppm : {-200.0, -100.0, 0.0, 35.0, 100.0}) {
    PlaybackClock clock(5e-4, 0.15e-3, PlaybackClock::Estimate::Middle);
    clock.start(at(0.0));
    const double rate = 1.0 + ppm * 1e-6;
    for (int look = 1; look <= 6000; ++look) {
      const double host = 0.1 * look;
      clock.observe_less_than(at(host - 0.00015), host * rate);
      clock.observe_at_least(at(host + 0.00015), host * rate);
      ASSERT_NEAR(clock.elapsed(at(host)), host * rate, 0.0003) << ppm << " ppm at " << host << " s";
      if (look > 100) {
        ASSERT_NEAR(clock.elapsed(at(host)), host * rate, 0.00002) << ppm << " ppm at " << host << " s";
      }
    }
    EXPECT_NEAR(clock.error_ppm(), ppm, 0.1);
  }
}

TEST(PlaybackClock, AWrongReportCannotThrowItFurtherThanACrystalCanBe) {
  PlaybackClock clock(5e-4, 1e-3);
  clock.start(at(0.0));
  clock.observe_at_least(at(10.0), 500.0);
  EXPECT_NEAR(clock.elapsed(at(10.0)), 10.0, 0.0051);
  clock.observe_less_than(at(20.0), 1.0);
  EXPECT_NEAR(clock.elapsed(at(20.0)), 20.0, 0.0101);
}

TEST(PlaybackClock, FollowsACrystalThatChanges) {
  PlaybackClock clock(5e-4, 1e-3);
  clock.start(at(0.0));
  clock.observe_at_least(at(100.0), 100.02);
  clock.observe_less_than(at(200.0), 199.99);
  EXPECT_LT(clock.elapsed(at(200.0)), 199.992);
}

TEST(PlaybackClock, ADriveThatFollowsTheHostPlaysAtItsRate) {
  PlaybackClock clock(5e-4, 1e-3);
  clock.start(at(10.0), true);
  // Whole milliseconds of a drive whose start was noted half a sample late, seen a sample late.
  for (int look = 1; look <= 60000; ++look) {
    const double host = 0.01 * look;
    const double passed = std::floor((host - 0.0015) / 0.1) * 0.1;
    clock.observe_at_least(at(10.0 + host), passed);
    clock.observe_less_than(at(10.0 + host), passed + 0.1);
    ASSERT_DOUBLE_EQ(clock.elapsed(at(10.0 + host)), seconds(at(10.0 + host) - at(10.0)));
  }
  EXPECT_TRUE(clock.follows_host());
  EXPECT_DOUBLE_EQ(clock.error_ppm(), 0.0);
  EXPECT_NEAR(clock.least_elapsed(at(610.0)), 600.0 - 0.003, 1e-9) << "not the 300 ms of a crystal";
  EXPECT_NEAR(clock.most_elapsed(at(610.0)), 600.0 + 0.003, 1e-9);
  EXPECT_DOUBLE_EQ(clock.least_elapsed(at(10.001)), 0.0);
}

TEST(PlaybackClock, PlanIsWrittenAtTheDrivesRateAndWhatItIsBehindMadeGood) {
  PlaybackClock clock(5e-4, 1e-3, PlaybackClock::Estimate::Middle);
  EXPECT_DOUBLE_EQ(clock.goal_rate(0.1), 1.0) << "nothing plays";
  clock.start(at(0.0));
  clock.observe_at_least(at(1000.0), 1000.1);
  clock.observe_less_than(at(1000.0), 1000.1);
  EXPECT_NEAR(clock.error_ppm(), 100.0, 1.0);
  EXPECT_NEAR(clock.goal_rate(0.0), 1.0 - 100e-6, 1.5e-6);
  EXPECT_NEAR(clock.goal_rate(0.4e-3), 1.0 + 100e-6, 1.5e-6) << "in two seconds";
  EXPECT_DOUBLE_EQ(clock.goal_rate(1.0), 1.001);
  EXPECT_DOUBLE_EQ(clock.goal_rate(-1.0), 0.999);
  clock.start(at(2000.0), true);
  EXPECT_DOUBLE_EQ(clock.goal_rate(0.4e-3), 1.0) << "the drive makes it good itself";
}

// What the FIFO has told until then is not lost.
TEST(PlaybackClock, ADriveThatStopsFollowingIsKnownByWhatWasSeen) {
  PlaybackClock clock(5e-4, 1e-3);
  clock.start(at(0.0), true);
  clock.observe_at_least(at(100.0), 100.010);
  clock.observe_less_than(at(100.0), 100.012);
  EXPECT_DOUBLE_EQ(clock.elapsed(at(200.0)), 200.0);
  clock.stop_following();
  EXPECT_NEAR(clock.elapsed(at(200.0)), 200.0 * (1.0 + 0.009 / 100.0), 1e-6);
  EXPECT_NEAR(clock.error_ppm(), 90.0, 1e-6);
  EXPECT_NEAR(clock.most_elapsed(at(200.0)), 200.0 * (1.0 + 0.013 / 100.0) + 1e-3, 1e-6);
  clock.start(at(0.0), true);
  EXPECT_TRUE(clock.follows_host()) << "the next motion begins anew";
}

}  // namespace
}  // namespace interpolated_motion::axis
