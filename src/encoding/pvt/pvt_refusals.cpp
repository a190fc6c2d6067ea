#include "pvt_refusals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "interpolated_motion_driver/encoding/record_range.h"
#include "interpolated_motion_driver/interpolation/cubic_hermite.h"

namespace interpolated_motion::encoding {

namespace {

Refusal refusal_at(const trajectory::Path& path, const PvtEncoding& encoding, std::int64_t sample,
                   const std::string& reason) {
  const GoalTime time = path.start_time() + DriveMilliseconds(sample);
  return {GoalError::InvalidGoal,
          fmt::format("Joint '{}', at {:.3f} s: {}", encoding.joint, time.count(), reason)};
}

/// Greatest magnitude of something over samples, and where.
struct Peak {
  double value = 0.0;
  std::int64_t sample = 0;

  void take(double candidate, std::int64_t at) {
    if (!(std::abs(candidate) > value)) return;
    value = std::abs(candidate);
    sample = at;
  }
};

std::int64_t last_after(const PvtEncoding& encoding, const KnotSearch& search) {
  return std::min(search.samples().end(), search.dead_end().sample + encoding.max_record_ms);
}

/// rpm of the motor, of the path itself over the longest record from the dead end.
Peak path_velocity(const PvtEncoding& encoding, const KnotSearch& search) {
  Peak peak;
  for (auto k = search.dead_end().sample; k <= last_after(encoding, search); ++k) {
    peak.take(interpolation::rpm(search.samples().velocity(k), encoding.transmission.counts_per_revolution),
              k);
  }
  return peak;
}

/// rpm/s of the motor, of the path itself over the longest record from the dead end.
Peak path_acceleration(const trajectory::Path& path, const PvtEncoding& encoding, const KnotSearch& search) {
  Peak peak;
  for (auto k = search.dead_end().sample; k <= last_after(encoding, search); ++k) {
    const GoalTime time = path.start_time() + DriveMilliseconds(k);
    if (time <= path.end_time())
      peak.take(encoding.transmission.motor_rpm(path.sample(time).acceleration), k);
  }
  return peak;
}

/// The record from the dead end that comes nearest to its rules, of those with the end rounded to nearest.
struct NearestRecord {
  SegmentFigures figures;
  double excess =
      std::numeric_limits<double>::infinity();  ///< greatest figure over its limit; the bound weighs more
};

PvtKnot nearest_knot(const KnotSearch& search, std::int64_t sample) {
  const PathSamples& samples = search.samples();
  const bool last = sample == samples.end();
  const double position = std::round(last ? samples.final_position() : samples.position(sample));
  const double velocity = last ? 0.0 : std::round(samples.velocity(sample) / search.rules().velocity_unit);
  return {sample, static_cast<std::int32_t>(position), static_cast<std::int32_t>(velocity)};
}

double excess_of(const SegmentFigures& figures, const SegmentRules& rules) {
  constexpr double kBoundFirst = 1e9;
  if (figures.deviation > rules.bound) return kBoundFirst * figures.deviation / rules.bound;
  return std::max(figures.peak_velocity / rules.max_velocity,
                  figures.peak_acceleration / rules.max_acceleration);
}

NearestRecord nearest_record(const PvtEncoding& encoding, const KnotSearch& search) {
  NearestRecord nearest;
  for (auto k = search.dead_end().sample + 1; k <= last_after(encoding, search); ++k) {
    const auto figures =
        execute(search.samples(), search.rules(), search.dead_end(), nearest_knot(search, k));
    const double excess = excess_of(figures, search.rules());
    if (excess < nearest.excess) nearest = {figures, excess};
  }
  return nearest;
}

std::string velocity_reason(const char* what, double rpm, const PvtEncoding& encoding) {
  return fmt::format(
      "{} {:.1f} rpm of the motor, more than the drive's limit of {:.1f} rpm (0x607F). Slow the trajectory "
      "down or "
      "raise the drive's limit.",
      what, rpm, encoding.max_motor_rpm);
}

std::string acceleration_reason(const char* what, double rpm_per_second, const PvtEncoding& encoding) {
  return fmt::format(
      "{} {:.0f} rpm/s of the motor, more than the drive's limit of {:.0f} rpm/s (0x60C5). Slow the "
      "trajectory down "
      "or raise the drive's limit; a finer velocity unit (0x608B, now {} rpm) lowers the peaks that come "
      "from rounding.",
      what, rpm_per_second, encoding.max_motor_acceleration, encoding.velocity_unit_rpm);
}

std::string record_reason(const PvtEncoding& encoding, const KnotSearch& search) {
  constexpr const char* kWhat = "the drive's cubic would peak at";
  const SegmentFigures figures = nearest_record(encoding, search).figures;
  const SegmentRules& rules = search.rules();
  const double resolution = encoding.transmission.counts_per_revolution;
  if (figures.deviation > rules.bound) {
    return fmt::format(
        "no record keeps the drive within {} counts of the path; the best one deviates by {:.3f} counts. "
        "Make the "
        "trajectory smoother there, raise the bound, or use a finer velocity unit (0x608B, now {} rpm).",
        rules.bound, figures.deviation, encoding.velocity_unit_rpm);
  }
  if (figures.peak_velocity / rules.max_velocity > figures.peak_acceleration / rules.max_acceleration) {
    return velocity_reason(kWhat, interpolation::rpm(figures.peak_velocity, resolution), encoding);
  }
  return acceleration_reason(kWhat, interpolation::rpm_per_second(figures.peak_acceleration, resolution),
                             encoding);
}

}  // namespace

Refusal refuse_start(const trajectory::Path& path, const PvtEncoding& encoding, const PvtKnot& knot,
                     double deviation) {
  return refusal_at(
      path, encoding, knot.sample,
      fmt::format("the drive's demand of {} counts is {:.3f} counts off the path, the bound is {} counts. "
                  "Start the trajectory where the drive stands.",
                  knot.position, deviation, encoding.bound_counts));
}

Refusal refuse_position(const trajectory::Path& path, const PvtEncoding& encoding, std::int64_t sample,
                        double counts) {
  return refusal_at(
      path, encoding, sample,
      fmt::format("position {:.0f} counts does not fit into a record, which takes {} .. {} counts. Keep "
                  "the joint within range, or home the drive nearer to it.",
                  counts, kMinRecordPosition, kMaxRecordPosition));
}

Refusal refuse_velocity(const trajectory::Path& path, const PvtEncoding& encoding, std::int64_t sample,
                        double units) {
  const double unit = encoding.velocity_unit_rpm;
  return refusal_at(
      path, encoding, sample,
      fmt::format("velocity {:.1f} rpm of the motor does not fit into a record, which takes +-{} units of "
                  "{} rpm. Slow the trajectory down or use a coarser velocity unit (0x608B).",
                  units * unit, kMaxRecordVelocity, unit));
}

Refusal refuse_dead_end(const trajectory::Path& path, const PvtEncoding& encoding, const KnotSearch& search) {
  const Peak velocity = path_velocity(encoding, search);
  if (velocity.value > encoding.max_motor_rpm) {
    return refusal_at(path, encoding, velocity.sample,
                      velocity_reason("the path needs", velocity.value, encoding));
  }
  const Peak acceleration = path_acceleration(path, encoding, search);
  if (acceleration.value > encoding.max_motor_acceleration) {
    return refusal_at(path, encoding, acceleration.sample,
                      acceleration_reason("the path needs", acceleration.value, encoding));
  }
  return refusal_at(path, encoding, search.dead_end().sample, record_reason(encoding, search));
}

}  // namespace interpolated_motion::encoding
