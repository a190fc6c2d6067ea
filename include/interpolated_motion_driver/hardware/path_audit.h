#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/hardware/demand_sample.h"
#include "interpolated_motion_driver/hardware/mechanism.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::hardware {

/// Holds the demand of an emulated drive against the path of the goal, at every sample of the drive, in
/// counts. The samples may come while the drive moves or afterwards, from a drive emulated elsewhere.
class PathAudit {
 public:
  /// `mechanism`: what is between the drive and the joint, whatever the driver takes it for. `axis` must
  /// outlive the audit. `host_time`: the drive has no clock of its own for its motion, it follows the host's.
  PathAudit(const Mechanism& mechanism, const axis::Axis& axis, bool host_time)
      : mechanism_(mechanism), axis_(&axis), host_time_(host_time) {}

  /// Samples from `now` on belong to `path`.
  void begin(const trajectory::Path& path, HostTime now);
  /// The path has changed, behind the samples so far.
  void follow(const trajectory::Path& path);
  /// Samples after `now` are not compared: the drive has been told to leave the path.
  void end(HostTime now);
  /// Forgets the samples, not the path.
  void clear();
  /// One sample of the drive while it interpolates.
  void add(const DemandSample& sample);

  /// Samples compared since begin() or clear(); both deviations are magnitudes, 0 without samples.
  std::uint64_t samples() const { return samples_; }
  double worst_deviation() const { return worst_; }  ///< counts
  double final_deviation() const { return final_; }  ///< counts, at the last sample compared
  double count() const;                              ///< rad or m of the joint in one count, above 0

 private:
  Mechanism mechanism_;
  const axis::Axis* axis_;
  bool host_time_;
  trajectory::Path path_;
  HostTime begin_ = kNever;
  HostTime end_ = kNever;
  std::uint64_t samples_ = 0;
  double worst_ = 0.0;
  double final_ = 0.0;
};

}  // namespace interpolated_motion::hardware
