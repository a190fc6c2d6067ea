#include "interpolated_motion_driver/trajectory/remainder.h"

#include <vector>

#include <gtest/gtest.h>

namespace interpolated_motion::trajectory {
namespace {

Path two_pieces() {
  return Path({{GoalTime{1.0}, GoalTime{1.5}, Polynomial{{0.2, 0.1, -0.4, 2.0, -1.0, 0.5}}},
               {GoalTime{1.5}, GoalTime{2.25}, Polynomial{{0.3, -0.6, 0.9, 0.0, 0.7, 0.0}}}});
}

TEST(Remainder, SaysTheSameByAnotherClock) {
  const Path path = two_pieces();
  for (const double from : {1.0, 1.2, 1.5, 1.9}) {
    for (const double rate : {1.0, 0.9995, 1.25}) {
      const Path rest = remainder(path, GoalTime{from}, rate);
      EXPECT_EQ(rest.start_time().count(), 0.0);
      EXPECT_NEAR(rest.end_time().count(), (2.25 - from) / rate, 1e-12);
      for (double t = 0.0; from + rate * t < 2.25; t += 0.013) {
        const State state = rest.sample(GoalTime{t});
        const State original = path.sample(GoalTime{from + rate * t});
        EXPECT_NEAR(state.position, original.position, 1e-12);
        EXPECT_NEAR(state.velocity, rate * original.velocity, 1e-11);
        EXPECT_NEAR(state.acceleration, rate * rate * original.acceleration, 1e-10);
      }
    }
  }
}

TEST(Remainder, OfAPathThatHasEndedIsItsLastPosition) {
  const Path path = two_pieces();
  for (const double from : {2.25, 7.0}) {
    const Path rest = remainder(path, GoalTime{from}, 1.0);
    EXPECT_TRUE(rest.empty());
    EXPECT_EQ(rest.final_position(), path.final_position());
  }
}

}  // namespace
}  // namespace interpolated_motion::trajectory
