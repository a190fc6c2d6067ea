#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"

namespace interpolated_motion::trajectory {

inline Waypoint point(double time, std::vector<double> positions, std::vector<double> velocities = {},
                      std::vector<double> accelerations = {}) {
  return {GoalTime(time), std::move(positions), std::move(velocities), std::move(accelerations), {}};
}

inline HostTime host_time(double s) { return HostTime(host_duration(s)); }

/// One rule set for `count` joints joint1, joint2, ...
inline GoalRules rules_for(std::size_t count, const JointLimits& limits = {}) {
  GoalRules rules;
  for (std::size_t i = 0; i < count; ++i) {
    rules.joints.push_back("joint" + std::to_string(i + 1));
    rules.limits.push_back(limits);
    rules.start_tolerance.push_back(0.1);
    rules.lead_in_threshold.push_back(1e-4);
  }
  return rules;
}

inline JointLimits limits_of(double velocity, double acceleration) {
  JointLimits limits;
  limits.max_velocity = velocity;
  limits.max_acceleration = acceleration;
  return limits;
}

inline std::vector<double> numbers(const YAML::Node& node) {
  return node ? node.as<std::vector<double>>() : std::vector<double>();
}

/// A goal of config/goals.
inline Goal load_goal(const std::string& name) {
  const YAML::Node file = YAML::LoadFile(std::string(IMD_SOURCE_DIR) + "/config/goals/" + name);
  Goal goal;
  goal.joint_names = file["joint_names"].as<std::vector<std::string>>();
  for (const YAML::Node& node : file["points"]) {
    const YAML::Node time = node["time_from_start"];
    const double s = time["secs"].as<double>() + 1e-9 * time["nsecs"].as<double>();
    goal.points.push_back(
        point(s, numbers(node["positions"]), numbers(node["velocities"]), numbers(node["accelerations"])));
  }
  return goal;
}

}  // namespace interpolated_motion::trajectory
