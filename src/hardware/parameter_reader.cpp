#include "interpolated_motion_driver/hardware/parameter_reader.h"

#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/units/closest_name.h"

namespace interpolated_motion::hardware {

namespace {

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "\"" + node.Scalar() + "\"";
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a map" : "empty";
}

}  // namespace

ParameterReader::ParameterReader(const YAML::Node& node, std::string path)
    : node_(node), path_(std::move(path)) {
  if (!node_.IsDefined() || node_.IsNull() || node_.IsMap()) return;
  throw std::invalid_argument(
      path_.empty() ? fmt::format("The configuration is {}; it must be a map with the keys joints, "
                                  "buses and drives.",
                                  shown(node_))
                    : fmt::format("Parameter {} is {}; it must be a map.", path_, shown(node_)));
}

bool ParameterReader::has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }

void ParameterReader::fail(const std::string& key, const std::string& what) const {
  throw std::invalid_argument(
      fmt::format("Parameter {}{}{} {}.", path_, path_.empty() || key.empty() ? "" : "/", key, what));
}

YAML::Node ParameterReader::required(const std::string& key) {
  known_.insert(key);
  if (!has(key)) fail(key, "is missing");
  return node_[key];
}

double ParameterReader::required_number(const std::string& key, double low, double high) {
  const YAML::Node value = required(key);
  double number = 0.0;
  try {
    number = value.as<double>();
  } catch (const YAML::Exception&) {
    fail(key, fmt::format("is {}; it must be a number within {}..{}", shown(value), low, high));
  }
  if (!(number >= low && number <= high)) fail(key, fmt::format("is {}; allowed: {}..{}", number, low, high));
  return number;
}

double ParameterReader::number(const std::string& key, double fallback, double low, double high) {
  known_.insert(key);
  return has(key) ? required_number(key, low, high) : fallback;
}

std::int64_t ParameterReader::required_integer(const std::string& key, std::int64_t low, std::int64_t high) {
  const YAML::Node value = required(key);
  std::int64_t number = 0;
  try {
    number = value.as<std::int64_t>();
  } catch (const YAML::Exception&) {
    fail(key, fmt::format("is {}; it must be a whole number within {}..{}", shown(value), low, high));
  }
  if (number < low || number > high) fail(key, fmt::format("is {}; allowed: {}..{}", number, low, high));
  return number;
}

std::int64_t ParameterReader::integer(const std::string& key, std::int64_t fallback, std::int64_t low,
                                      std::int64_t high) {
  known_.insert(key);
  return has(key) ? required_integer(key, low, high) : fallback;
}

bool ParameterReader::boolean(const std::string& key, bool fallback) {
  known_.insert(key);
  if (!has(key)) return fallback;
  try {
    return node_[key].as<bool>();
  } catch (const YAML::Exception&) {
    fail(key, fmt::format("is {}; it must be true or false", shown(node_[key])));
  }
}

std::string ParameterReader::required_text(const std::string& key) {
  const YAML::Node value = required(key);
  if (!value.IsScalar()) fail(key, fmt::format("is {}; it must be a text", shown(value)));
  return value.Scalar();
}

std::string ParameterReader::required_name(const std::string& key) {
  std::string name = required_text(key);
  if (name.empty()) fail(key, "is empty; it must be a name");
  return name;
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) {
  known_.insert(key);
  return has(key) ? required_text(key) : fallback;
}

std::vector<std::string> ParameterReader::names(const std::string& key) {
  const YAML::Node value = required(key);
  if (!value.IsSequence() || value.size() == 0)
    fail(key, fmt::format("is {}; it must be a list of names", shown(value)));
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const auto& item : value) {
    if (!item.IsScalar() || item.Scalar().empty()) fail(key, "holds an entry that is not a name");
    if (item.Scalar().find('/') != std::string::npos) {
      fail(key,
           fmt::format(
               "names \"{}\"; a name must not have a slash, at which ROS takes parameters apart: rename it, "
               "in the URDF too",
               item.Scalar()));
    }
    if (!seen.insert(item.Scalar()).second) fail(key, fmt::format("names \"{}\" twice", item.Scalar()));
    names.push_back(item.Scalar());
  }
  return names;
}

ParameterReader ParameterReader::map(const std::string& key) {
  known_.insert(key);
  return {has(key) ? node_[key] : YAML::Node(), path_.empty() ? key : path_ + "/" + key};
}

std::vector<std::string> ParameterReader::keys() const {
  std::vector<std::string> keys;
  if (!node_.IsMap()) return keys;
  for (const auto& entry : node_) keys.push_back(entry.first.Scalar());
  return keys;
}

void ParameterReader::refuse_unknown() const {
  std::set<std::string> seen;
  for (const std::string& key : keys()) {
    if (!seen.insert(key).second) fail(key, "is given twice; leave one of both out");
    if (known_.count(key) != 0) continue;
    const std::string meant = closest_name(key, {known_.begin(), known_.end()});
    const std::string question = meant.empty() ? "" : "did you mean " + meant + "? ";
    fail(key, "is unknown; " + question + fmt::format("known here: {}", fmt::join(known_, ", ")));
  }
}

}  // namespace interpolated_motion::hardware
