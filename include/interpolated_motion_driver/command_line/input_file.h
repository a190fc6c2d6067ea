#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/command_line/output_file.h"

namespace interpolated_motion::command_line {

/// Opens a file that a user has named, to read it. Never waits: only regular files are taken, neither FIFOs
/// nor devices. Throws std::runtime_error: the path and why it cannot be read.
OpenFile open_input_file(const std::string& path);

/// The content of such a file. Throws as open_input_file().
std::string read_text_file(const std::string& path);

/// The first document of a YAML file that a user has named. Throws std::runtime_error as read_text_file(),
/// or with the path, line and column at which it is no YAML or a key of a map is given twice.
YAML::Node read_yaml_file(const std::string& path);

}  // namespace interpolated_motion::command_line
