#include "interpolated_motion_driver/recording/yaml_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::recording {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

void append_values(std::string& text, const char* key, const std::vector<double>& values) {
  if (!values.empty()) text += fmt::format(", {}: {}", key, list(values));
}

std::string point_text(const trajectory::Waypoint& point) {
  std::string text = fmt::format("{{time_from_start: {}", number(point.time.count()));
  append_values(text, "positions", point.positions);
  append_values(text, "velocities", point.velocities);
  append_values(text, "accelerations", point.accelerations);
  append_values(text, "efforts", point.efforts);
  return text + "}";
}

std::string tolerances_text(const char* key, const std::vector<trajectory::JointTolerance>& tolerances) {
  if (tolerances.empty()) return {};
  std::string text;
  for (const trajectory::JointTolerance& one : tolerances)
    text += fmt::format("{}{{joint: {}, position: {}, velocity: {}, acceleration: {}}}",
                        text.empty() ? "" : ", ", in_quotes(one.joint), number(one.position),
                        number(one.velocity), number(one.acceleration));
  return fmt::format(", {}: [{}]", key, text);
}

/// Recordings of earlier versions have revolute joints alone.
trajectory::JointUnit parse_unit(const YAML::Node& unit) {
  using trajectory::JointUnit;
  const bool is_length = unit && unit.as<std::string>() == trajectory::symbol(JointUnit::Metre);
  return is_length ? JointUnit::Metre : JointUnit::Radian;
}

std::vector<double> parse_values(const YAML::Node& values) {
  return values ? values.as<std::vector<double>>() : std::vector<double>{};
}

trajectory::Waypoint parse_point(const YAML::Node& map) {
  return {GoalTime{map["time_from_start"].as<double>()}, parse_values(map["positions"]),
          parse_values(map["velocities"]), parse_values(map["accelerations"]), parse_values(map["efforts"])};
}

std::vector<trajectory::JointTolerance> parse_tolerances(const YAML::Node& tolerances) {
  std::vector<trajectory::JointTolerance> all;
  for (const YAML::Node& one : tolerances)
    all.push_back({one["joint"].as<std::string>(), one["position"].as<double>(), one["velocity"].as<double>(),
                   one["acceleration"].as<double>()});
  return all;
}

}  // namespace

std::string one_line(const YAML::Node& yaml) {
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << yaml;
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const bool is_utf8 = (static_cast<unsigned char>(c) & 0x80U) != 0;  // YAML's own encoding
    if (is_utf8 || (c >= ' ' && c <= '~')) {
      out += c;
    } else {
      out += fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out + '"';
}

std::string number(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  return fmt::format("{}", value);
}

std::string list(const std::vector<double>& numbers) {
  std::string text;
  for (const double value : numbers) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::string list(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + in_quotes(text);
  return "[" + all + "]";
}

std::string time_text(HostTime time) {
  const std::int64_t count = time.time_since_epoch().count();
  const std::int64_t magnitude = std::abs(count);
  return fmt::format("{}{}.{:09}", count < 0 ? "-" : "", magnitude / kSecond, magnitude % kSecond);
}

HostTime parse_time(const std::string& text) {
  const std::size_t point = text.find('.');
  char* end = nullptr;
  const std::int64_t whole = std::strtoll(text.c_str(), &end, 10);
  const bool readable = point != std::string::npos && text.size() == point + 10 &&
                        end == text.c_str() + point &&
                        text.find_first_not_of("0123456789", point + 1) == std::string::npos;
  if (!readable)
    throw std::invalid_argument(
        fmt::format("\"{}\" is no time: seconds with nine digits behind the point", text));
  const std::int64_t fraction = std::strtoll(text.c_str() + point + 1, nullptr, 10);
  return HostTime{HostDuration{whole * kSecond + (text.front() == '-' ? -fraction : fraction)}};
}

std::string goal_text(const trajectory::Goal& goal) {
  std::string points;
  for (const trajectory::Waypoint& point : goal.points)
    points += (points.empty() ? "" : ", ") + point_text(point);
  std::string text = fmt::format("joint_names: {}, points: [{}]", list(goal.joint_names), points);
  if (goal.start) text += ", start: " + time_text(*goal.start);
  text += tolerances_text("path_tolerance", goal.path_tolerance);
  text += tolerances_text("goal_tolerance", goal.goal_tolerance);
  if (goal.goal_time_tolerance != 0.0) text += ", goal_time_tolerance: " + number(goal.goal_time_tolerance);
  return text;
}

trajectory::Goal parse_goal(const YAML::Node& map) {
  trajectory::Goal goal;
  goal.joint_names = map["joint_names"].as<std::vector<std::string>>();
  for (const YAML::Node& point : map["points"]) goal.points.push_back(parse_point(point));
  if (map["start"]) goal.start = parse_time(map["start"].as<std::string>());
  goal.path_tolerance = parse_tolerances(map["path_tolerance"]);
  goal.goal_tolerance = parse_tolerances(map["goal_tolerance"]);
  goal.goal_time_tolerance = map["goal_time_tolerance"].as<double>(0.0);
  return goal;
}

std::string limits_text(const std::map<std::string, trajectory::JointLimits>& limits) {
  std::string text;
  for (const auto& [joint, one] : limits)
    text += fmt::format(
        "{}{}: {{min_position: {}, max_position: {}, max_velocity: {}, max_acceleration: {}, continuous: "
        "{}, unit: {}}}",
        text.empty() ? "" : ", ", in_quotes(joint), number(one.min_position), number(one.max_position),
        number(one.max_velocity), number(one.max_acceleration), one.continuous, symbol(one.unit));
  return "{" + text + "}";
}

std::map<std::string, trajectory::JointLimits> parse_limits(const YAML::Node& map) {
  std::map<std::string, trajectory::JointLimits> limits;
  for (const auto& joint : map) {
    const YAML::Node& one = joint.second;
    limits[joint.first.as<std::string>()] = {
        one["min_position"].as<double>(), one["max_position"].as<double>(),
        one["max_velocity"].as<double>(), one["max_acceleration"].as<double>(),
        one["continuous"].as<bool>(),     parse_unit(one["unit"])};
  }
  return limits;
}

}  // namespace interpolated_motion::recording
