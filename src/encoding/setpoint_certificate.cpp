#include "interpolated_motion_driver/encoding/setpoint_certificate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/encoding/record_range.h"
#include "interpolated_motion_driver/interpolation/cip_polynomial.h"

namespace interpolated_motion::encoding {

namespace {

using interpolation::CipPolynomial;
using interpolation::CipValues;
using interpolation::kCipHighestOrder;
using interpolation::kCipHistory;

/// Periods by which an instant may miss the grid of target positions and is taken for one of it.
constexpr double kOnTheGrid = 1e-6;

template <class Value>
void require(bool valid, const SetpointEncoding& encoding, const char* name, const Value& value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(
      fmt::format("setpoints of joint {}: {} is {}, allowed is {}", encoding.joint, name, value, range));
}

void validate(const SetpointEncoding& e) {
  require(e.period.count() > 0.0, e, "period", e.period.count(), "above 0 s");
  require(e.order >= 1 && e.order <= kCipHighestOrder, e, "order", e.order, "1..3");
  require(e.servo_period.count() > 0.0 && e.servo_period <= e.period, e, "servo_period",
          e.servo_period.count(), "above 0 s to period");
  require(e.bound_counts > 0.0, e, "bound_counts", e.bound_counts, "above 0");
}

/// A path read at times that only grow.
class PathSweep {
 public:
  explicit PathSweep(const trajectory::Path& path) : path_(path) {}

  double position(GoalTime time) {
    if (path_.empty() || time < path_.start_time() || time > path_.end_time())
      return path_.sample(time).position;
    piece_ = path_.piece_index(time, piece_);
    const trajectory::Piece& piece = path_.pieces()[piece_];
    return piece.polynomial.position((time - piece.start).count());
  }

 private:
  const trajectory::Path& path_;
  std::size_t piece_ = 0;
};

/// The drive's motion from the setpoints of a path, the first of them at `first`.
class Execution {
 public:
  Execution(const trajectory::Path& path, const SetpointEncoding& encoding, GoalTime first)
      : encoding_(encoding), setpoints_(path), samples_(path), next_(first) {}

  /// The drive's samples from one setpoint to the next. False when a setpoint fits no target position.
  bool advance(SetpointCertificate& worst) {
    std::copy_backward(values_.begin(), values_.end() - 1, values_.end());
    const double counts = encoding_.transmission.counts(setpoints_.position(next_));
    if (!fits_record_position(counts)) return false;
    values_[0] = std::round(counts);
    if (++known_ >= kCipHistory) compare(next_ - encoding_.period, worst);
    next_ += encoding_.period;
    return true;
  }

  GoalTime next() const { return next_; }

 private:
  void compare(GoalTime t0, SetpointCertificate& worst) {
    const CipPolynomial demand =
        interpolation::cip_position_polynomial(encoding_.order, encoding_.period.count(), values_);
    for (GoalTime tau{0.0}; tau < encoding_.period; tau += encoding_.servo_period) {
      const double wanted = encoding_.transmission.counts(samples_.position(t0 + tau));
      const double deviation = std::abs(demand.value(tau.count()) - wanted);
      if (deviation <= worst.worst_deviation) continue;
      worst.worst_deviation = deviation;
      worst.worst_time = t0 + tau;
    }
  }

  const SetpointEncoding& encoding_;
  PathSweep setpoints_;
  PathSweep samples_;
  GoalTime next_;
  CipValues values_{};  // the newest first
  std::size_t known_ = 0;
};

/// The largest acceleration of a demand made of polynomials, each in effect for a period. Within one it is
/// extreme at the ends; from one to the next the velocity steps, and behind a missing target position the
/// demand itself, which the drive sees as the second difference of its samples there.
class AccelerationWatch {
 public:
  explicit AccelerationWatch(const SetpointEncoding& encoding)
      : period_(encoding.period.count()), servo_period_(encoding.servo_period.count()) {}

  /// `begin`: s after its second knot, when it takes effect.
  void take(const CipPolynomial& demand, double begin = 0.0) {
    note(demand.second_derivative(begin));
    note(demand.second_derivative(begin + period_));
    if (known_) {
      const double rise = demand.value(begin + servo_period_) - demand.value(begin);
      const double step = demand.value(begin) - last_value_;
      note((std::abs(rise - last_rise_) + std::abs(step)) / (servo_period_ * servo_period_));
    }
    know(demand, begin + period_);
  }
  /// One that is not judged: where the next one sets out, at `end`, s after its second knot.
  void know(const CipPolynomial& demand, double end) {
    last_value_ = demand.value(end);
    last_rise_ = last_value_ - demand.value(end - servo_period_);
    known_ = true;
  }
  double worst() const { return worst_; }

 private:
  void note(double acceleration) { worst_ = std::max(worst_, std::abs(acceleration)); }

  double period_;
  double servo_period_;
  double last_value_ = 0.0;
  double last_rise_ = 0.0;
  bool known_ = false;
  double worst_ = 0.0;
};

Refusal beyond_range(const SetpointEncoding& encoding, GoalTime time) {
  return {GoalError::InvalidGoal,
          fmt::format("Joint '{}', at {:.3f} s: the position is no target position of 32 bits (0x607A). "
                      "Check counts_per_revolution, gear_ratio and offset.",
                      encoding.joint, time.count())};
}

Refusal beyond_bound(const SetpointEncoding& encoding, const SetpointCertificate& found) {
  return {GoalError::InvalidGoal,
          fmt::format("Joint '{}', at {:.3f} s: with a target position each {:.0f} ms the drive would be "
                      "{:.2f} counts off the path, more than deviation_bound allows ({}). Use a shorter "
                      "sync_period, smoother or slower points, or a larger bound.",
                      encoding.joint, found.worst_time.count(), encoding.period.count() * 1e3,
                      found.worst_deviation, encoding.bound_counts)};
}

Refusal beyond_stream_bound(const SetpointEncoding& encoding, const SetpointCertificate& found) {
  return {GoalError::InvalidGoal,
          fmt::format("Joint '{}': on the way to the setpoint, with a target position each {:.0f} ms, the "
                      "drive would be {:.2f} counts off the path, more than stream_deviation_bound allows "
                      "({}). Use a shorter sync_period, smoother or slower setpoints, or a larger bound.",
                      encoding.joint, encoding.period.count() * 1e3, found.worst_deviation,
                      encoding.bound_counts)};
}

Refusal beyond_acceleration(const SetpointEncoding& encoding, double found) {
  return {GoalError::InvalidGoal,
          fmt::format(
              "Joint '{}': with a target position each {:.0f} ms the drive would accelerate by {:.4g} per "
              "s^2 from one of its samples to the next, more than limit_margin times the joint's limit "
              "allows ({:.4g}): the acceleration changes too much at a point. Give accelerations at the "
              "points, use smoother or slower ones, or a shorter sync_period.",
              encoding.joint, encoding.period.count() * 1e3, found, encoding.max_acceleration)};
}

}  // namespace

std::int32_t setpoint_at(const trajectory::Path& path, const Transmission& transmission, GoalTime time) {
  const double counts = std::round(transmission.counts(path.sample(time).position));
  return static_cast<std::int32_t>(std::clamp<double>(counts, kMinRecordPosition, kMaxRecordPosition));
}

Expected<SetpointCertificate, Refusal> certify_setpoints(const trajectory::Path& path,
                                                         const SetpointEncoding& encoding) {
  return certify_setpoints_from(path.start_time() - kCipHistory * encoding.period, path, encoding);
}

Expected<SetpointCertificate, Refusal> certify_setpoints_from(GoalTime first, const trajectory::Path& path,
                                                              const SetpointEncoding& encoding) {
  validate(encoding);
  const GoalTime history = kCipHistory * encoding.period;
  SetpointCertificate worst;
  for (int phase = 0; phase < kSetpointPhases; ++phase) {
    const GoalTime shift = encoding.period * phase / kSetpointPhases;
    Execution execution(path, encoding, first + shift);
    while (execution.next() < path.end_time() + history) {
      if (!execution.advance(worst)) return beyond_range(encoding, execution.next());
    }
    worst.acceleration = std::max(worst.acceleration, demand_acceleration(path, first + shift, encoding));
  }
  if (worst.worst_deviation > encoding.bound_counts) return beyond_bound(encoding, worst);
  if (encoding.order > 1 && worst.acceleration > encoding.max_acceleration)
    return beyond_acceleration(encoding, worst.acceleration);
  return worst;
}

Expected<SetpointCertificate, Refusal> certify_stream_from(GoalTime first, const trajectory::Path& path,
                                                           const SetpointEncoding& encoding) {
  validate(encoding);
  SetpointCertificate worst;
  Execution execution(path, encoding, first);
  while (execution.next() < path.end_time() + kCipHistory * encoding.period) {
    if (!execution.advance(worst)) return beyond_range(encoding, execution.next());
  }
  if (worst.worst_deviation > encoding.bound_counts) return beyond_stream_bound(encoding, worst);
  return worst;
}

double demand_acceleration(const trajectory::Path& path, GoalTime first, const SetpointEncoding& encoding) {
  AccelerationWatch watch(encoding);
  PathSweep setpoints(path);
  CipValues values{};
  std::size_t known = 0;
  const GoalTime end = path.end_time() + kCipHistory * encoding.period;
  for (GoalTime time = first; time < end; time += encoding.period) {
    std::copy_backward(values.begin(), values.end() - 1, values.end());
    values[0] = setpoints.position(time);
    if (++known < kCipHistory) continue;
    watch.take(interpolation::cip_position_polynomial(encoding.order, encoding.period.count(), values));
  }
  return watch.worst();
}

double demand_acceleration(interpolation::CipKnots known, GoalTime next, GoalTime until,
                           const trajectory::Path& way_on, const SetpointEncoding& encoding) {
  if (encoding.order == 1) return 0.0;
  AccelerationWatch watch(encoding);
  PathSweep setpoints(way_on);
  const auto demand = [&] { return interpolation::cip_polynomial_through(encoding.order, known); };
  watch.know(demand(), (next - encoding.period).count() - known[1].time);
  for (; next <= until; next += encoding.period) {
    std::copy_backward(known.begin(), known.end() - 1, known.end());
    known[0] = {next.count(), setpoints.position(next)};
    watch.take(demand(), (next - encoding.period).count() - known[1].time);
  }
  return watch.worst();
}

double demand_departure(interpolation::CipKnots known, GoalTime next, GoalTime until,
                        const trajectory::Path& way_on, const trajectory::Path& path,
                        const SetpointEncoding& encoding) {
  double worst = 0.0;
  PathSweep wanted(path);
  for (GoalTime time{known[0].time}; next <= until; next += encoding.period) {
    const CipPolynomial demand = interpolation::cip_polynomial_through(encoding.order, known);
    for (; time < next - encoding.period; time += encoding.servo_period)
      worst = std::max(worst, std::abs(demand.value(time.count() - known[1].time) - wanted.position(time)));
    std::copy_backward(known.begin(), known.end() - 1, known.end());
    const std::int32_t counts = setpoint_at(way_on, encoding.transmission, next);
    known[0] = {next.count(), encoding.transmission.joint_position(counts)};
  }
  return worst * std::abs(encoding.transmission.counts_per_radian());
}

std::optional<AccelerationPeak> find_acceleration_beyond(const trajectory::Path& before, GoalTime known,
                                                         const trajectory::Path& way_on,
                                                         const SetpointEncoding& encoding) {
  if (encoding.order == 1) return std::nullopt;
  AccelerationWatch watch(encoding);
  PathSweep setpoints(way_on);
  CipValues values{};
  const auto demand = [&] {
    return interpolation::cip_position_polynomial(encoding.order, encoding.period.count(), values);
  };
  const GoalTime ahead = std::max(way_on.start_time() - known, GoalTime{0.0});
  const GoalTime join = known + std::floor(ahead / encoding.period + kOnTheGrid) * encoding.period;
  for (std::size_t i = 0; i < kCipHistory; ++i)
    values[i] = before.sample(join - static_cast<double>(i) * encoding.period).position;
  watch.know(demand(), encoding.period.count());
  const GoalTime end = way_on.end_time() + kCipHistory * encoding.period;
  for (GoalTime time = join + encoding.period; time < end; time += encoding.period) {
    std::copy_backward(values.begin(), values.end() - 1, values.end());
    values[0] = setpoints.position(time);
    watch.take(demand());
    if (watch.worst() > encoding.max_acceleration) return AccelerationPeak{time, watch.worst()};
  }
  return std::nullopt;
}

}  // namespace interpolated_motion::encoding
