#pragma once

#include <string>

#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// When the flight recorder's recording is written to a file.
enum class WriteRecording {
  OnFault,    ///< at each fault of the group, and when it is asked for
  OnRequest,  ///< when it is asked for
  Never,
};

/// The flight recorder: the last seconds of everything, in memory.
struct RecorderConfiguration {
  double seconds = 10.0;
  double megabytes = 8.0;  ///< of memory, 2^20 bytes each
  WriteRecording write = WriteRecording::OnFault;
  std::string folder = "recordings";  ///< for the files, below the process's working folder
  int keep = 20;                      ///< files; the oldest are removed
};

/// Reads `flight_recorder`. Throws like ParameterReader.
RecorderConfiguration parse_flight_recorder(ParameterReader reader);

}  // namespace interpolated_motion::hardware
