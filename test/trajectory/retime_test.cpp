#include "interpolated_motion_driver/trajectory/retime.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace interpolated_motion::trajectory {
namespace {

constexpr GoalTime kFirst{-std::numeric_limits<double>::infinity()};

Path two_pieces() {
  return Path({{GoalTime{0.5}, GoalTime{1.25}, Polynomial{{0.2, 0.0, -0.4, 2.0, -1.0, 0.5}}},
               {GoalTime{1.25}, GoalTime{2.0}, Polynomial{{0.56328125, 1.8134765625, 0.9, -2.0, 0.7, 0.0}}}});
}

TEST(Retime, IsThePathItselfByTheNominalLaw) {
  const Path path = two_pieces();
  const Path same = retimed(path, TimeLaw{}, kFirst);
  EXPECT_EQ(same.start_time().count(), 0.5);
  EXPECT_EQ(same.end_time().count(), 2.0);
  for (double t = 0.0; t < 2.2; t += 0.013) {
    EXPECT_NEAR(same.sample(GoalTime{t}).position, path.sample(GoalTime{t}).position, 1e-15);
    EXPECT_NEAR(same.sample(GoalTime{t}).velocity, path.sample(GoalTime{t}).velocity, 1e-14);
  }
}

TEST(Retime, StretchesAtAConstantRate) {
  const Path path = two_pieces();
  for (const double rate : {0.1, 0.5, 1.7}) {
    const TimeLaw law(rate, GoalTime{3.0}, GoalTime{0.5});
    const Path slow = retimed(path, law, kFirst);
    EXPECT_NEAR(slow.start_time().count(), 3.0, 1e-12);
    EXPECT_NEAR(slow.end_time().count(), 3.0 + 1.5 / rate, 1e-12);
    for (double s = 0.5; s < 2.0; s += 0.013) {
      const State is = slow.sample(GoalTime{3.0 + (s - 0.5) / rate});
      const State was = path.sample(GoalTime{s});
      EXPECT_NEAR(is.position, was.position, 1e-12);
      EXPECT_NEAR(is.velocity, rate * was.velocity, 1e-11);
      EXPECT_NEAR(is.acceleration, rate * rate * was.acceleration, 1e-10);
    }
  }
}

/// The rate goes from 1 to `end` in 0.8 .. 1.2 s, in steps as long as they may be.
TimeLaw ramp(double end) {
  TimeLaw law;
  const double h = kRetimedPiece.count();
  double slope = 0.0;
  double rate = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double bend = (i < 20 ? 1.0 : -1.0) * (end - 1.0) / 0.04;
    law.bend(GoalTime{0.8 + i * h}, slope, bend);
    rate += h * slope + 0.5 * bend * h * h;
    slope += h * bend;
  }
  EXPECT_NEAR(rate, end, 1e-12);
  law.settle(GoalTime{1.2}, end);
  return law;
}

// A quintic through the states at both ends of h is off by at most h^6 / 46080 times the sixth derivative of
// what it stands for: q(s(t)) has one of some 1e5 here, so less than 3e-12 rad.
TEST(Retime, FollowsAChangingRate) {
  const Path path = two_pieces();
  for (const double end : {0.0, 0.3, 1.6}) {
    const TimeLaw law = ramp(end);
    const Path changed = retimed(path, law, GoalTime{0.8});
    EXPECT_EQ(changed.start_time().count(), 0.8);
    for (double t = 0.8; t < 1.8; t += 0.0013) {
      const TimeLaw::Instant now = law.at(GoalTime{t});
      const State nominal = path.sample(now.nominal);
      const State state = changed.sample(GoalTime{t});
      EXPECT_NEAR(state.position, nominal.position, 3e-12) << t;
      EXPECT_NEAR(state.velocity, now.rate * nominal.velocity, 1e-8) << t;
    }
  }
}

TEST(Retime, EndsWhereTheRateComesToNothing) {
  const Path path = two_pieces();
  const Path stopped = retimed(path, ramp(0.0), GoalTime{0.8});
  EXPECT_NEAR(stopped.end_time().count(), 1.2, 1e-12);
  EXPECT_NEAR(stopped.final_position(), path.sample(GoalTime{1.0}).position, 1e-12);
  EXPECT_NEAR(stopped.sample(stopped.end_time()).velocity, 0.0, 1e-9);
}

TEST(Retime, GoesOnAfterAPause) {
  const Path path = two_pieces();
  TimeLaw law = ramp(0.0);
  law.bend(GoalTime{3.0}, 2.0, 0.0);  // the slope is steeper than a drive would like: all the same here
  law.settle(GoalTime{3.5}, 1.0);
  const Path whole = retimed(path, law, GoalTime{0.8});
  EXPECT_NEAR(whole.sample(GoalTime{2.0}).position, path.sample(GoalTime{1.0}).position, 1e-12);
  EXPECT_NEAR(whole.end_time().count(), 3.5 + 2.0 - 1.25, 1e-9);
}

TEST(Retime, OfAPathThatRestsIsIt) {
  EXPECT_TRUE(retimed(Path(0.7), ramp(0.3), GoalTime{0.0}).empty());
  EXPECT_EQ(retimed(Path(0.7), ramp(0.3), GoalTime{0.0}).final_position(), 0.7);
}

TEST(Retime, HasNoMoreThanWasAskedFor) {
  const Path part = retimed(two_pieces(), ramp(0.5), GoalTime{0.8}, GoalTime{1.0});
  EXPECT_GE(part.end_time().count(), 1.0 - 1e-9);
  EXPECT_LE(part.end_time().count(), 1.0 + kRetimedPiece.count() + 1e-9);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
