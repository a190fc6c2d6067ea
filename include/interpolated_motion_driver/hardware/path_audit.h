#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/epos_drive.h"
#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::hardware {

/// Holds the demand of an emulated drive against the path of the goal, at every sample of the drive, in
/// counts.
class PathAudit {
 public:
  explicit PathAudit(const encoding::Transmission& transmission) : transmission_(transmission) {}

  /// From now on samples belong to `path`, whose start is the drive's sample 0.
  void begin(const trajectory::Path& path);
  /// Samples are no longer compared: the drive has been told to leave the path.
  void end() { comparing_ = false; }
  void add(const emulation::EposSample& sample);

  std::uint64_t samples() const { return samples_; }
  double worst_deviation() const { return worst_; }  ///< counts
  double final_deviation() const { return final_; }  ///< counts, at the last sample compared

 private:
  encoding::Transmission transmission_;
  trajectory::Path path_;
  bool comparing_ = false;
  std::uint64_t samples_ = 0;
  double worst_ = 0.0;
  double final_ = 0.0;
};

}  // namespace interpolated_motion::hardware
