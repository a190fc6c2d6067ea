#include "ims_refusals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace interpolated_motion::encoding {

namespace {

Refusal refusal_at(const ImsEncoding& encoding, GoalTime time, const std::string& reason) {
  return {GoalError::InvalidGoal,
          fmt::format("Joint '{}', at {:.3f} s: {}", encoding.joint, time.count(), reason)};
}

/// Greatest magnitude of something over the path, and when.
struct Peak {
  double value = 0.0;
  GoalTime time{0.0};

  void take(double candidate, GoalTime at) {
    if (!(std::abs(candidate) > value)) return;
    value = std::abs(candidate);
    time = at;
  }
};

/// What the path itself asks of the motor over the longest segment from the dead end.
struct PathPeaks {
  Peak rpm;
  Peak acceleration;  ///< rpm/s

  PathPeaks(const trajectory::Path& path, const ImsEncoding& encoding, const ImsSearch& search) {
    const std::int64_t first = search.dead_end().tick;
    const std::int64_t last = std::min(search.samples().end(), first + encoding.max_segment_ticks);
    for (std::int64_t k = first; k <= last; ++k) {
      const GoalTime time = search.samples().goal_time(k);
      if (time < path.start_time() || time > path.end_time()) continue;
      const trajectory::State state = path.sample(time);
      rpm.take(encoding.transmission.motor_rpm(state.velocity), time);
      acceleration.take(encoding.transmission.motor_rpm(state.acceleration), time);
    }
  }
};

double rpm_limit(const ImsEncoding& encoding, const ImsRules& rules) {
  return std::min(encoding.max_motor_rpm,
                  static_cast<double>(rules.max_velocity) / rules.scale.units_per_rpm());
}

double acceleration_limit(const ImsEncoding& encoding, const ImsRules& rules) {
  const double field = static_cast<double>(rules.max_step) / rules.scale.units_per_rpm() / rules.scale.tick;
  return std::min(encoding.max_motor_acceleration, field);
}

}  // namespace

Refusal refuse_start(const ImsEncoding& encoding, GoalTime time, double counts, double deviation) {
  return refusal_at(
      encoding, time,
      fmt::format("the drive's demand of {:.3f} counts is {:.3f} counts off the path, the bound "
                  "is {} counts. Start the trajectory where the drive stands.",
                  counts, deviation, encoding.bound_counts));
}

Refusal refuse_position(const ImsEncoding& encoding, GoalTime time, double counts, double most) {
  return refusal_at(encoding, time,
                    fmt::format("position {:.0f} counts cannot be encoded, allowed is +-{:.0f} counts. Keep "
                                "the joint within range, or home the drive nearer to it.",
                                counts, most));
}

Refusal refuse_dead_end(const trajectory::Path& path, const ImsEncoding& encoding, ImsSearch& search) {
  const ImsRules& rules = search.rules();
  const PathPeaks peaks(path, encoding, search);
  const double max_rpm = rpm_limit(encoding, rules);
  if (peaks.rpm.value > max_rpm) {
    return refusal_at(
        encoding, peaks.rpm.time,
        fmt::format("the path needs {:.1f} rpm of the motor, more than the limit of {:.1f} rpm (a segment "
                    "takes up to {:.0f} rpm). Slow the trajectory down.",
                    peaks.rpm.value, max_rpm, rules.scale.velocity_full_scale_rpm));
  }
  const double max_acceleration = acceleration_limit(encoding, rules);
  if (peaks.acceleration.value > max_acceleration) {
    return refusal_at(
        encoding, peaks.acceleration.time,
        fmt::format("the path needs {:.0f} rpm/s of the motor, more than the limit of {:.0f} rpm/s. Slow the "
                    "trajectory down or raise the limit.",
                    peaks.acceleration.value, max_acceleration));
  }
  return refusal_at(
      encoding, search.samples().goal_time(search.dead_end().tick),
      fmt::format("no segment of {} ticks or more keeps the drive within {} counts of the path at up to "
                  "{:.0f} rpm/s; the path itself peaks at {:.0f} rpm/s. Make the trajectory smoother there, "
                  "raise the bound or the limit, or allow shorter segments.",
                  encoding.min_segment_ticks, encoding.bound_counts, max_acceleration,
                  peaks.acceleration.value));
}

}  // namespace interpolated_motion::encoding
