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
  return {read<std::int32_t>(node["secs"], what + ": secs"),
          read<std::int32_t>(node["nsecs"], what + ": nsecs")};
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

trajectory_msgs::JointTrajectory read_trajectory(const YAML::Node& node) {
  if (!node.IsMap()) throw std::runtime_error("it is no map with joint_names and points");
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
