#include "interpolated_motion_driver/encoding/pvt/segment_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpolated_motion_driver/interpolation/cubic_hermite.h"

namespace interpolated_motion::encoding {

namespace {

/// Samples tested, in eighths of the segment. The middle first: that is where a segment that is too long
/// fails.
constexpr int kTestedEighths[] = {4, 2, 6, 1, 7, 3, 5};

/// The Hermite cubic by its distance from the start, t ms after it: the form that is quick to set up for many
/// ends.
class Rise {
 public:
  Rise(double total, double start_velocity, double end_velocity, double length) : velocity_(start_velocity) {
    const double inverse = 1.0 / length;
    const double mean = total * inverse;
    quadratic_ = (3 * mean - 2 * start_velocity - end_velocity) * inverse;
    cubic_ = (start_velocity + end_velocity - 2 * mean) * inverse * inverse;
  }
  double at(double t) const { return t * (velocity_ + t * (quadratic_ + t * cubic_)); }

 private:
  double velocity_;
  double quadratic_;
  double cubic_;
};

}  // namespace

SegmentFit::SegmentFit(const PathSamples& samples, const SegmentRules& rules, double bound,
                       const PvtKnot& from)
    : samples_(&samples),
      rules_(&rules),
      bound_(bound),
      start_(from.sample),
      position_(from.position),
      velocity_(from.velocity * rules.velocity_unit) {}

VelocityInterval SegmentFit::within_bound(std::int64_t duration, double end_position) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  VelocityInterval interval{-kInfinity, kInfinity};
  const auto length = static_cast<double>(duration);
  const Rise rise(end_position - position_, velocity_, 0.0, length);
  const double* path = samples_->positions_from(start_);
  for (const int eighth : kTestedEighths) {
    const std::int64_t k = duration * eighth / 8;
    if (k == 0) continue;
    const auto t = static_cast<double>(k);
    const double missing = path[k] - position_ - rise.at(t);
    const double per_count = length * length / (t * t * (t - length));  // negative
    interval.low = std::max(interval.low, (missing + bound_) * per_count);
    interval.high = std::min(interval.high, (missing - bound_) * per_count);
    if (interval.empty()) break;
  }
  return interval;
}

VelocityInterval SegmentFit::within_limits(VelocityInterval interval, std::int64_t duration,
                                           double end_position) const {
  // Acceleration is 6 D / T^2 - (4 V0 + 2 V1) / T at the start and -6 D / T^2 + (2 V0 + 4 V1) / T at the end.
  const auto length = static_cast<double>(duration);
  const double slope = 6 * (end_position - position_) / length;
  const double reach = rules_->max_acceleration * length;
  interval.low = std::max({interval.low, (slope - 4 * velocity_ - reach) / 2,
                           (slope - 2 * velocity_ - reach) / 4, -rules_->max_knot_velocity});
  interval.high = std::min({interval.high, (slope - 4 * velocity_ + reach) / 2,
                            (slope - 2 * velocity_ + reach) / 4, rules_->max_knot_velocity});
  return interval;
}

bool SegmentFit::keeps_bound(std::int64_t duration, double end_position, double end_velocity) const {
  const Rise rise(end_position - position_, velocity_, end_velocity, static_cast<double>(duration));
  const double* path = samples_->positions_from(start_);
  for (const int eighth : kTestedEighths) {
    const std::int64_t k = duration * eighth / 8;
    if (k == 0) continue;
    if (!(std::abs(path[k] - position_ - rise.at(static_cast<double>(k))) <= bound_)) return false;
  }
  return true;
}

bool SegmentFit::keeps_limits(std::int64_t duration, double end_position, double end_velocity) const {
  const interpolation::CubicHermite cubic({position_, velocity_}, {end_position, end_velocity},
                                          static_cast<double>(duration));
  return cubic.peak_velocity() <= rules_->max_velocity &&
         cubic.peak_acceleration() <= rules_->max_acceleration;
}

SegmentFigures execute(const PathSamples& samples, const SegmentRules& rules, const PvtKnot& from,
                       const PvtKnot& to) {
  const std::int64_t duration = to.sample - from.sample;
  const interpolation::CubicHermite cubic(
      {static_cast<double>(from.position), from.velocity * rules.velocity_unit},
      {static_cast<double>(to.position), to.velocity * rules.velocity_unit}, static_cast<double>(duration));
  SegmentFigures figures;
  const double* path = samples.positions_from(from.sample);
  for (std::int64_t k = 1; k <= duration; ++k) {
    figures.deviation = std::max(figures.deviation, std::abs(cubic.position_at(k) - path[k]));
  }
  figures.peak_velocity = cubic.peak_velocity();
  figures.peak_acceleration = cubic.peak_acceleration();
  return figures;
}

}  // namespace interpolated_motion::encoding
