#pragma once

#include <algorithm>
#include <string>

#include <yaml-cpp/yaml.h>

namespace interpolated_motion::simulation {

/// YAML on one line.
inline std::string yaml_line(const YAML::Node& yaml) {
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << yaml;
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace interpolated_motion::simulation
