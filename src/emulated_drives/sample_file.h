#pragma once

#include <optional>
#include <string>

#include "interpolated_motion_driver/command_line/output_file.h"
#include "interpolated_motion_driver/emulation/drive.h"

namespace interpolated_motion::emulated_drives {

/// Writes the samples of one drive's latest motion to FOLDER/NAME, from the first one that interpolates until
/// the drive stands; a new motion begins the file anew. A line a sample: host time in ns (CLOCK_MONOTONIC),
/// time of the drive since the start of its motion in s, demand and actual position in counts, and 1 while it
/// interpolates. The file is complete up to the end of the interpolation before the drive tells of it, and
/// whenever the demand has come to rest.
class SampleFile {
 public:
  /// Throws std::runtime_error when the file cannot be written, is no regular one, or holds something else
  /// than such samples.
  SampleFile(const std::string& folder, const std::string& name);

  void add(const emulation::DemandSample& sample);

 private:
  std::string path_;
  command_line::OpenFile file_;
  std::optional<emulation::DemandSample> last_;
  bool moving_ = false;
  bool rested_ = false;  ///< the demand did not change at the last sample
};

}  // namespace interpolated_motion::emulated_drives
