#include <cmath>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic/way_back.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"

namespace interpolated_motion::axis {
namespace {

trajectory::JointLimits limits() {
  trajectory::JointLimits limits;
  limits.max_velocity = 3.5;
  limits.max_acceleration = 5.0;
  return limits;
}

encoding::SetpointEncoding encoding_of(int order) {
  encoding::SetpointEncoding encoding;
  encoding.order = order;
  encoding.period = GoalTime{0.005};
  encoding.max_acceleration = 1.2 * 5.0;
  return encoding;
}

/// Brakes at 4.2 rad/s^2 from 2 rad/s on, until it is at rest.
trajectory::Path braking() {
  return trajectory::Path({{GoalTime{0.0}, GoalTime{2.0 / 4.2}, {{0.0, 2.0, -2.1}}}});
}

/// A drive that has not begun to brake with the path at `start`, and goes straight on for two periods.
Departure gone_straight_on(GoalTime start) {
  const trajectory::State left = braking().sample(start);
  Departure from;
  from.start = from.next = start + GoalTime{0.01};
  from.state = {left.position + 0.01 * left.velocity, left.velocity, 0.0};
  for (std::size_t i = 0; i < from.known.size(); ++i) {
    const double back = -0.005 * static_cast<double>(i);
    from.known[i] = {start.count() + back, left.position + back * left.velocity};
  }
  return from;
}

// From no acceleration a quintic to one of 4.2 rad/s^2 has 5.8 rad/s^2 on its way, however long it is.
TEST(WayBack, IsFoundWhereThePathNeedsMostOfTheLimit) {
  for (const int order : {1, 2, 3}) {
    const encoding::SetpointEncoding encoding = encoding_of(order);
    const Departure from = gone_straight_on(GoalTime{0.1});
    const auto way = way_back(braking(), from, limits(), encoding);
    ASSERT_TRUE(way) << order;
    trajectory::JointLimits most = limits();
    most.max_acceleration *= 1.1 + 1e-9;
    EXPECT_FALSE(trajectory::find_limit_violation(*way, most)) << order;
    EXPECT_DOUBLE_EQ(way->sample(from.start).position, from.state.position);
    EXPECT_DOUBLE_EQ(way->sample(from.start).velocity, from.state.velocity);
    const GoalTime back = way->pieces().front().end;
    EXPECT_LE((back - from.start).count(), 0.25 + 1e-9);
    EXPECT_NEAR(way->sample(back).position, braking().sample(back).position, 1e-9);
  }
}

// A quarter of a second is too little for two radians.
TEST(WayBack, IsNoneFromTooFarAway) {
  Departure from = gone_straight_on(GoalTime{0.1});
  from.state.position += 2.0;
  EXPECT_FALSE(way_back(braking(), from, limits(), encoding_of(3)));
}

}  // namespace
}  // namespace interpolated_motion::axis
