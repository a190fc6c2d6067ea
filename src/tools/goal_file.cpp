#include "goal_file.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/command_line/input_file.h"

namespace interpolated_motion::tools {
namespace {

template <class Value>
Value read(const YAML::Node& node, const std::string& what) {
  try {
    return node.as<Value>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(what + " is missing or of the wrong type");
  }
}

std::vector<double> read_numbers(const YAML::Node& point, const std::string& key, const std::string& where) {
  if (!point[key]) return {};
  return read<std::vector<double>>(point[key], where + ": " + key);
}

ros::Duration read_duration(const YAML::Node& node, const std::string& what) {
  if (!node || !node.IsMap()) return ros::Duration(read<double>(node, what));
  const bool is_ros2 = node["sec"].IsDefined();
  const char* secs = is_ros2 ? "sec" : "secs";
  const char* nsecs = is_ros2 ? "nanosec" : "nsecs";
  return {read<std::int32_t>(node[secs], what + ": " + secs),
          read<std::int32_t>(node[nsecs], what + ": " + nsecs)};
}

trajectory_msgs::JointTrajectoryPoint read_point(const YAML::Node& node, const std::string& where) {
  if (!node.IsMap()) throw std::runtime_error(where + " is no map");
  trajectory_msgs::JointTrajectoryPoint point;
  point.positions = read_numbers(node, "positions", where);
  point.velocities = read_numbers(node, "velocities", where);
  point.accelerations = read_numbers(node, "accelerations", where);
  point.effort = read_numbers(node, "effort", where);
  point.time_from_start = read_duration(node["time_from_start"], where + ": time_from_start");
  return point;
}

std::string keys_of(const YAML::Node& map) {
  std::string keys;
  for (const auto& entry : map) keys += (keys.empty() ? "" : ", ") + entry.first.Scalar();
  return keys;
}

/// The trajectory in what `rostopic echo` prints of messages that have one: goals of the action, with their
/// header or without, moveit_msgs' RobotTrajectory and DisplayTrajectory.
YAML::Node trajectory_within(YAML::Node node) {
  while (node.IsMap() && !node["joint_names"].IsDefined()) {
    YAML::Node within(YAML::NodeType::Undefined);
    const YAML::Node outer = node;
    for (const char* key : {"goal", "trajectory", "joint_trajectory"}) {
      if (outer[key].IsDefined()) within.reset(outer[key]);
    }
    if (!within.IsDefined()) {
      throw std::runtime_error(
          "joint_names is missing; there are " + keys_of(node) +
          ". A trajectory_msgs/JointTrajectory is wanted, alone or within an action's goal, a "
          "FollowJointTrajectoryGoal or a RobotTrajectory");
    }
    if (within.IsSequence() && within.size() == 1) within.reset(within[0]);
    node.reset(within);
  }
  if (!node.IsMap()) throw std::runtime_error("it is no map with joint_names and points");
  return node;
}

trajectory_msgs::JointTrajectory read_trajectory(const YAML::Node& content) {
  const YAML::Node node = trajectory_within(content);
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = read<std::vector<std::string>>(node["joint_names"], "joint_names");
  const YAML::Node points = node["points"];
  if (!points || !points.IsSequence()) throw std::runtime_error("points is missing or no list");
  trajectory.points.reserve(points.size());
  for (const YAML::Node& point : points) {
    trajectory.points.push_back(read_point(point, fmt::format("point {}", trajectory.points.size())));
  }
  return trajectory;
}

}  // namespace

trajectory_msgs::JointTrajectory read_goal_file(const std::string& path) {
  const YAML::Node content = command_line::read_yaml_file(path);
  try {
    return read_trajectory(content);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("goal file {}: {}", path, error.what()));
  }
}

}  // namespace interpolated_motion::tools
