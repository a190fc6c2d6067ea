#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::hardware {

/// Holds the demand of an emulated drive against the path of the goal, at every sample of the drive, in
/// counts.
class PathAudit {
 public:
  /// `axis` must outlive the audit.
  PathAudit(const encoding::Transmission& transmission, const axis::Axis& axis)
      : transmission_(transmission), axis_(&axis) {}

  /// From now on samples belong to `path`.
  void begin(const trajectory::Path& path);
  /// Samples are no longer compared: the drive has been told to leave the path.
  void end() { comparing_ = false; }
  /// One sample of the drive: its demand in counts, `drive_seconds` on its own clock after its motion began.
  void add(double drive_seconds, double demand);

  std::uint64_t samples() const { return samples_; }
  double worst_deviation() const { return worst_; }  ///< counts
  double final_deviation() const { return final_; }  ///< counts, at the last sample compared

 private:
  encoding::Transmission transmission_;
  const axis::Axis* axis_;
  trajectory::Path path_;
  bool comparing_ = false;
  std::uint64_t samples_ = 0;
  double worst_ = 0.0;
  double final_ = 0.0;
};

}  // namespace interpolated_motion::hardware
