#pragma once

#include <cstdint>

#include "interpolated_motion_driver/encoding/pvt/path_samples.h"

namespace interpolated_motion::encoding {

/// A knot of the drive's motion, in the drive's own numbers.
struct PvtKnot {
  std::int64_t sample = 0;    ///< ms since the start of the path, >= 0
  std::int32_t position = 0;  ///< counts
  std::int32_t velocity = 0;  ///< in the drive's velocity unit
};

/// What every record has to keep, in counts and ms.
struct SegmentRules {
  double velocity_unit = 0.0;      ///< counts/ms per unit of a record's velocity
  double bound = 0.0;              ///< deviation from the path at any sample, counts
  double max_velocity = 0.0;       ///< counts/ms, anywhere on the segment
  double max_acceleration = 0.0;   ///< counts/ms^2, anywhere on the segment
  double max_knot_velocity = 0.0;  ///< counts/ms, what the record's field and max_velocity allow
};

/// What executing one quantised record gives, in counts and ms.
struct SegmentFigures {
  double deviation = 0.0;          ///< worst of the record's samples, counts
  double peak_velocity = 0.0;      ///< counts/ms
  double peak_acceleration = 0.0;  ///< counts/ms^2

  /// Whether all three are within the rules.
  bool keep(const SegmentRules& rules) const {
    return deviation <= rules.bound && peak_velocity <= rules.max_velocity &&
           peak_acceleration <= rules.max_acceleration;
  }
};

/// Closed interval of velocities, counts/ms; empty if low > high.
struct VelocityInterval {
  double low = 0.0;   ///< least and
  double high = 0.0;  ///< greatest velocity that is allowed
  /// True for a NaN too.
  bool empty() const { return !(low <= high); }
};

/// Segments that start at one knot. For a given end position, the cubic and its acceleration are linear in
/// the end velocity, so each rule leaves an interval of end velocities and the rules together the
/// intersection of these.
///
/// The bound is tested at a few samples spread over the segment: a necessary condition, quick to evaluate.
/// Whether a record keeps its rules is decided by execute().
class SegmentFit {
 public:
  /// `bound` (counts) applies instead of rules.bound: a little less, as the worst sample may lie between
  /// those tested. `samples` and `rules` must outlive this object.
  SegmentFit(const PathSamples& samples, const SegmentRules& rules, double bound, const PvtKnot& from);

  /// End velocities that keep the bound. `duration` in ms, >= 1; `end_position` in counts.
  VelocityInterval within_bound(std::int64_t duration, double end_position) const;

  /// The part of `interval` that keeps the limits of acceleration and, at the end, of velocity.
  VelocityInterval within_limits(VelocityInterval interval, std::int64_t duration, double end_position) const;

  /// Whether the segment to this end keeps the bound. Position in counts, velocity in counts/ms.
  bool keeps_bound(std::int64_t duration, double end_position, double end_velocity) const;

  /// Whether it keeps the limits of velocity and acceleration.
  bool keeps_limits(std::int64_t duration, double end_position, double end_velocity) const;

 private:
  const PathSamples* samples_;
  const SegmentRules* rules_;
  double bound_;
  std::int64_t start_;
  double position_;
  double velocity_;
};

/// Executes the record that leads from `from` to `to` as the drive does and compares every sample with the
/// path.
SegmentFigures execute(const PathSamples& samples, const SegmentRules& rules, const PvtKnot& from,
                       const PvtKnot& to);

}  // namespace interpolated_motion::encoding
