#include "interpolated_motion_driver/trajectory/speed_change.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "interpolated_motion_driver/trajectory/extrema.h"
#include "interpolated_motion_driver/trajectory/retime.h"

namespace interpolated_motion::trajectory {

namespace {

/// Parts of the ramp in which the slope rises and falls.
constexpr double kEase = 0.25;
/// Shares of the accelerations that are used, in turn: between the ends of its steps the motion may ask for
/// more than there.
constexpr double kShares[] = {1.0, 0.97, 0.9, 0.8, 0.6};

/// A range of slopes of the rate.
struct Slopes {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  /// |a + v * slope| <= limit, and 0 always: the motion as it is has been checked.
  void restrict_to(double v, double a, double limit) {
    if (std::abs(v) < 1e-12) return;
    const double one = (-limit - a) / v;
    const double other = (limit - a) / v;
    lowest = std::max(lowest, std::min(0.0, std::min(one, other)));
    highest = std::min(highest, std::max(0.0, std::max(one, other)));
  }
};

/// Finds the way to another rate in steps of `kRetimedPiece`.
class Ramp {
 public:
  Ramp(TimeLaw law, GoalTime from, const Speed& speed, const std::vector<Path>& nominal,
       const std::vector<JointLimits>& limits, double share)
      : law_(std::move(law)),
        time_(from),
        now_(law_.at(from)),
        target_(speed.rate),
        highest_(std::max({law_.final_rate(), now_.rate, target_})),
        steepest_(1.0 / ((1.0 - kEase) * speed.ramp.count())),
        bend_(steepest_ / (kEase * speed.ramp.count())),
        nominal_(nominal),
        limits_(limits),
        share_(share),
        hints_(nominal.size()) {}

  TimeLaw run() {
    const GoalTime end = nominal_end();
    law_.settle(time_, now_.rate);
    while (now_.nominal < end && !is_there()) step();
    law_.settle(time_, target_);
    return std::move(law_);
  }

 private:
  static constexpr double kStep = kRetimedPiece.count();
  static constexpr double kRounding = 1e-9;

  GoalTime nominal_end() const {
    GoalTime end = now_.nominal;
    for (const Path& path : nominal_) end = std::max(end, path.end_time());
    return end;
  }

  bool is_there() const { return now_.rate == target_ && now_.slope == 0.0; }

  /// What is left of a way to `rate` is at most a step with the slope that falls to 0.
  bool lands_at(double rate) const {
    const double missing = rate - now_.rate;
    return now_.slope * missing > 0.0 && 2.0 * missing / now_.slope <= kStep * (1.0 + kRounding);
  }

  void land_at(double rate) {
    const double length = 2.0 * (rate - now_.rate) / now_.slope;
    law_.bend(time_, now_.slope, -now_.slope / length);
    time_ += GoalTime{length};
    now_ = {law_.at(time_).nominal, rate, 0.0};
    law_.settle(time_, rate);
  }

  void step() {
    for (const double rate : {target_, 0.0, highest_}) {
      if (lands_at(rate)) return land_at(rate);
    }
    const double missing = target_ - now_.rate;
    const double wanted =
        std::copysign(std::min(steepest_, std::sqrt(2.0 * bend_ * std::abs(missing))), missing);
    double slope = std::clamp(wanted, now_.slope - bend_ * kStep, now_.slope + bend_ * kStep);
    const Slopes allowed = slopes_after(slope);
    slope = std::clamp(slope, allowed.lowest, allowed.highest);
    slope = std::clamp(slope, slope_to_land_at(missing < 0.0 ? target_ : 0.0),
                       slope_to_land_at(missing > 0.0 ? target_ : highest_));
    go_to(slope);
  }

  /// After a step to it, another one lands at `rate`.
  double slope_to_land_at(double rate) const { return (rate - now_.rate) / kStep - 0.5 * now_.slope; }

  /// Those that the joints have the acceleration for at the end of a step to `slope`.
  Slopes slopes_after(double slope) {
    const double rate = std::max(0.0, now_.rate + 0.5 * kStep * (now_.slope + slope));
    const GoalTime nominal = now_.nominal + GoalTime{0.5 * kStep * (now_.rate + rate)};
    Slopes slopes;
    for (std::size_t i = 0; i < nominal_.size(); ++i) {
      const Path& path = nominal_[i];
      if (path.empty() || nominal < path.start_time() || nominal > path.end_time()) continue;
      hints_[i] = path.piece_index(nominal, hints_[i]);
      const Piece& piece = path.pieces()[hints_[i]];
      const State state = piece.polynomial.state((nominal - piece.start).count());
      const double limit = share_ * limits_[i].max_acceleration * (1.0 + limits_[i].rate_slack);
      slopes.restrict_to(state.velocity, state.acceleration * rate * rate, limit);
    }
    return slopes;
  }

  void go_to(double slope) {
    const GoalTime end = time_ + kRetimedPiece;
    // A rate that stays is no new piece.
    if (slope != 0.0 || now_.slope != 0.0) law_.bend(time_, now_.slope, (slope - now_.slope) / kStep);
    now_ = law_.at(end);
    now_.slope = slope;
    time_ = end;
  }

  TimeLaw law_;
  GoalTime time_;
  TimeLaw::Instant now_;
  const double target_;
  const double highest_;   ///< rate: what it was to be, or is to be
  const double steepest_;  ///< of the slopes, 1/s
  const double bend_;      ///< 1/s^2
  const std::vector<Path>& nominal_;
  const std::vector<JointLimits>& limits_;
  const double share_;
  std::vector<std::size_t> hints_;  ///< piece of each path
};

std::optional<SpeedViolation> find_violation(const TimeLaw& law, GoalTime from,
                                             const std::vector<Path>& nominal,
                                             const std::vector<JointLimits>& limits) {
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    JointLimits rates = limits[i];
    rates.continuous = true;  // where the positions are has been checked
    const Path path = retimed(nominal[i], law, from, law.steady_from());
    if (auto violation = find_limit_violation(path, rates)) return SpeedViolation{i, *violation};
  }
  return std::nullopt;
}

double largest(const Range& range) {
  return std::max(std::abs(range.minimum.value), std::abs(range.maximum.value));
}

}  // namespace

double highest_rate(const std::vector<Path>& nominal, GoalTime from, const std::vector<JointLimits>& limits) {
  double highest = kHighestRate;
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    for (const Piece& piece : nominal[i].pieces()) {
      if (piece.end <= from) continue;
      const double begin = std::max(0.0, (from - piece.start).count());
      const double end = piece.duration().count();
      const double velocity = largest(velocity_range(piece.polynomial, begin, end));
      const double acceleration = largest(acceleration_range(piece.polynomial, begin, end));
      highest = std::min(
          {highest, limits[i].max_velocity / velocity, std::sqrt(limits[i].max_acceleration / acceleration)});
    }
  }
  return std::max(1.0, highest);
}

Expected<TimeLaw, SpeedViolation> speed_changed(const TimeLaw& law, GoalTime from, const Speed& speed,
                                                const std::vector<Path>& nominal,
                                                const std::vector<JointLimits>& limits) {
  Speed allowed = speed;
  if (speed.rate > 1.0)
    allowed.rate = std::min(speed.rate, highest_rate(nominal, law.at(from).nominal, limits));
  std::optional<SpeedViolation> first;
  for (const double share : kShares) {
    TimeLaw changed = Ramp(law, from, allowed, nominal, limits, share).run();
    const auto violation = find_violation(changed, from, nominal, limits);
    if (!violation) return changed;
    if (!first) first = violation;
  }
  return *first;
}

}  // namespace interpolated_motion::trajectory
