#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hardware/scenario.h"
#include "trajectory/random.h"

// Moves of the arms of kinds_of_arms.h, and what their drives make of them.
namespace interpolated_motion::test {

inline constexpr double kMaxVelocity = 3.5;       // rad/s, of every joint of these arms
inline constexpr double kMaxAcceleration = 20.0;  // rad/s^2
inline constexpr double kInterval = 0.02;         // s, over which differences are taken

/// What the demand of one joint does, by differences over kInterval.
class Watch {
 public:
  void take(double time, double position) {
    if (known_ > 0 && time - time_ < kInterval) return;
    if (known_ > 0) {
      const double velocity = (position - position_) / (time - time_);
      fastest_ = std::max(fastest_, std::abs(velocity));
      if (known_ > 1) hardest_ = std::max(hardest_, std::abs(velocity - velocity_) / (time - time_));
      velocity_ = velocity;
    }
    ++known_;
    time_ = time;
    position_ = position;
  }
  double fastest() const { return fastest_; }
  double hardest() const { return hardest_; }

 private:
  int known_ = 0;
  double time_ = 0.0;
  double position_ = 0.0;
  double velocity_ = 0.0;
  double fastest_ = 0.0;
  double hardest_ = 0.0;
};

/// All joints to somewhere else, so slowly that it is possible from most states of motion.
inline trajectory::Goal random_goal(trajectory::Random& random, const std::vector<double>& present,
                                    double effort) {
  trajectory::Goal goal;
  trajectory::Waypoint point;
  double duration = 0.4;
  for (std::size_t i = 0; i < present.size(); ++i) {
    goal.joint_names.push_back("joint" + std::to_string(i + 1));
    const double target = random.uniform(-1.5, 1.5);
    const double distance = std::abs(target - present[i]);
    point.positions.push_back(target);
    duration = std::max({duration, 1.875 * distance / (effort * kMaxVelocity),
                         std::sqrt(10.0 / std::sqrt(3.0) * distance / (effort * kMaxAcceleration))});
  }
  point.time = GoalTime{duration};
  point.velocities.assign(present.size(), 0.0);
  point.accelerations.assign(present.size(), 0.0);
  goal.points = {point};
  return goal;
}

}  // namespace interpolated_motion::test
