#include "interpolated_motion_driver/node/node_parameters.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::node {
namespace {

const std::vector<std::string>& controller_keys() {
  static const std::vector<std::string> keys{"type", "gains", "velocity_ff"};
  return keys;
}

std::string text_of(const YAML::Node& value) {
  if (value.IsScalar()) return "\"" + value.Scalar() + "\"";
  YAML::Emitter out;
  out << YAML::Flow << value;
  return out.c_str();
}

[[noreturn]] void refuse(const std::string& key, const YAML::Node& value, const std::string& allowed) {
  throw std::invalid_argument(
      fmt::format("Parameter {} is {}; it must be {}.", key, text_of(value), allowed));
}

/// Reads one scalar, or refuses it with a sentence that says what would be allowed.
template <class Value>
Value scalar(const YAML::Node& parameters, const std::string& key, Value fallback,
             const std::string& allowed) {
  const YAML::Node value = parameters[key];
  if (!value) return fallback;
  Value result{};
  if (!value.IsScalar() || !YAML::convert<Value>::decode(value, result)) refuse(key, value, allowed);
  return result;
}

struct Range {
  double low;
  double high;
};

double number(const YAML::Node& parameters, const std::string& key, double fallback, Range range,
              const std::string& unit) {
  const std::string allowed = fmt::format("a number from {:g} to {:g} {}", range.low, range.high, unit);
  const double value = scalar(parameters, key, fallback, allowed);
  if (!(value >= range.low && value <= range.high)) refuse(key, parameters[key], allowed);
  return value;
}

bool flag(const YAML::Node& parameters, const std::string& key, bool fallback) {
  return scalar(parameters, key, fallback, "true or false");
}

std::string text(const YAML::Node& parameters, const std::string& key) {
  return scalar(parameters, key, std::string(), "a text");
}

std::string frame_prefix(const YAML::Node& parameters, const std::string& key, const std::string& fallback) {
  const std::string allowed = "a text that does not begin with a slash, or empty for no such frames";
  auto prefix = scalar(parameters, key, fallback, allowed);
  if (!prefix.empty() && prefix.front() == '/') refuse(key, parameters[key], allowed);
  return prefix;
}

int priority(const YAML::Node& parameters, const std::string& key) {
  const std::string allowed = "a whole number from 0 (off) to 99";
  const int value = scalar(parameters, key, 0, allowed);
  if (value < 0 || value > 99) refuse(key, parameters[key], allowed);
  return value;
}

}  // namespace

NodeParameters parse_node_parameters(const YAML::Node& parameters) {
  NodeParameters node;
  node.state_publish_rate =
      number(parameters, "state_publish_rate", node.state_publish_rate, {0.1, 1000}, "Hz");
  node.action_monitor_rate =
      number(parameters, "action_monitor_rate", node.action_monitor_rate, {0.1, 1000}, "Hz");
  node.status_publish_rate =
      number(parameters, "status_publish_rate", node.status_publish_rate, {0.1, 1000}, "Hz");
  node.loop_period = number(parameters, "loop_period", node.loop_period, {0.0005, 0.1}, "s");
  node.realtime_priority = priority(parameters, "realtime_priority");
  node.wire_log = text(parameters, "wire_log");
  node.robot_description_file = text(parameters, "robot_description_file");
  node.emulated_samples = text(parameters, "emulated_samples");
  node.publish_tf = flag(parameters, "publish_tf", node.publish_tf);
  node.tf_demand_prefix = frame_prefix(parameters, "tf_demand_prefix", node.tf_demand_prefix);
  node.allow_fault_injection = flag(parameters, "allow_fault_injection", node.allow_fault_injection);
  node.allow_parameter_writes = flag(parameters, "allow_parameter_writes", node.allow_parameter_writes);
  return node;
}

const std::vector<std::string>& node_parameter_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all{"state_publish_rate", "action_monitor_rate", "status_publish_rate",
                                 "loop_period", "realtime_priority", "wire_log", "publish_tf",
                                 "tf_demand_prefix", "robot_description_file", "robot_description",
                                 "emulated_samples", "allow_fault_injection", "allow_parameter_writes",
                                 // read by diagnostic_updater and by actionlib
                                 "diagnostic_period", "follow_joint_trajectory"};
    all.insert(all.end(), controller_keys().begin(), controller_keys().end());
    return all;
  }();
  return keys;
}

std::vector<std::string> ignored_controller_keys(const YAML::Node& parameters) {
  std::vector<std::string> present;
  for (const std::string& key : controller_keys()) {
    if (parameters[key]) present.push_back(key);
  }
  return present;
}

}  // namespace interpolated_motion::node
