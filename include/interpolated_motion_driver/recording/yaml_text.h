#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

/// YAML on one line, in flow style, which a person can read and which gives the same numbers again to the
/// last bit.
namespace interpolated_motion::recording {

/// Any YAML.
std::string one_line(const YAML::Node& yaml);
/// In double quotes, with what does not print escaped.
std::string in_quotes(std::string_view text);
/// A number, also .nan and .inf.
std::string number(double value);
/// `[1, 2.5]`
std::string list(const std::vector<double>& numbers);
/// `["joint1", "joint2"]`
std::string list(const std::vector<std::string>& texts);
/// Seconds with nine digits behind the point: the host's clock to the nanosecond.
std::string time_text(HostTime time);
/// The reverse of time_text(). Throws std::invalid_argument.
HostTime parse_time(const std::string& text);

/// `joint_names: [...], points: [...], ...`: the goal without braces around it. `start` is host time.
std::string goal_text(const trajectory::Goal& goal);
/// The reverse, of the map in braces. Throws YAML::Exception or std::invalid_argument.
trajectory::Goal parse_goal(const YAML::Node& map);

/// `{joint1: {min_position: ...}, ...}` and the reverse, of the limits of a robot description.
std::string limits_text(const std::map<std::string, trajectory::JointLimits>& limits);
std::map<std::string, trajectory::JointLimits> parse_limits(const YAML::Node& map);

}  // namespace interpolated_motion::recording
