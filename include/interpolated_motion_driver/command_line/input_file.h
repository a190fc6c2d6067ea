#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

namespace interpolated_motion::command_line {

/// The content of a file that a user has named. Throws std::runtime_error: the path and why it cannot be
/// read.
std::string read_text_file(const std::string& path);

/// The first document of a YAML file that a user has named. Throws std::runtime_error as read_text_file(),
/// or with the path, line and column at which it is no YAML or a key of a map is given twice.
YAML::Node read_yaml_file(const std::string& path);

}  // namespace interpolated_motion::command_line
