#pragma once

#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::recording {

/// An order as it was recorded.
struct RecordedOrder {
  HostTime time{};
  std::string verb;
  YAML::Node arguments;  ///< a map
};

/// The group has come into Fault.
struct RecordedFault {
  HostTime time{};
  std::string text;
};

/// What of a recording can be carried out again, and what came of it.
struct RecordingFile {
  std::string cause;
  HostTime begin{};
  HostTime end{};
  bool complete = false;  ///< it begins with the driver
  YAML::Node configuration;
  std::map<std::string, trajectory::JointLimits> limits;
  std::vector<RecordedOrder> orders;
  std::vector<RecordedFault> faults;
};

/// Reads what to_text() has written. Throws std::invalid_argument with the number of the line that is wrong.
RecordingFile parse_recording(const std::string& text);

}  // namespace interpolated_motion::recording
