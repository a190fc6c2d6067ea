#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace interpolated_motion::trajectory {

namespace {

/// s: a ramp or a hold that is shorter is left out.
constexpr double kShortest = 1e-9;

void validate(const Braking& braking) {
  if (!(braking.max_acceleration > 0.0)) {
    throw std::invalid_argument(fmt::format(
        "jerk-limited stop: max_acceleration is {}, but must be greater than 0", braking.max_acceleration));
  }
  if (!(braking.ramp.count() > 0.0)) {
    throw std::invalid_argument(
        fmt::format("jerk-limited stop: ramp is {} s, but must be greater than 0", braking.ramp.count()));
  }
}

/// The velocity that is left when the acceleration is ramped to 0 at once.
double velocity_left(const State& state, double jerk) {
  return state.velocity + state.acceleration * std::abs(state.acceleration) / (2.0 * jerk);
}

/// A joint that brakes too hard for what is left of its velocity eases off more quickly.
double jerk_for(const State& from, double jerk) {
  const bool brakes = from.velocity * from.acceleration < 0.0;
  const bool turns = brakes && velocity_left(from, jerk) * from.velocity < 0.0;
  if (!turns) return jerk;
  const double without_turning = from.acceleration * from.acceleration / (2.0 * std::abs(from.velocity));
  return std::min(without_turning, kHardestRamp * jerk);
}

/// Durations (s) of the two ramps and of the hold between them, and the acceleration that is held.
struct Profile {
  double first = 0.0;
  double hold = 0.0;
  double last = 0.0;
  double peak = 0.0;  ///< signed
};

/// Closed form: with the signs turned so that the velocity left is positive, the velocity goes down by
/// (peak^2 - a^2) / 2j on the first ramp, by peak * hold, and by peak^2 / 2j on the last one.
Profile profile(const State& from, double jerk, double max_acceleration) {
  const double sign = velocity_left(from, jerk) >= 0.0 ? 1.0 : -1.0;
  const double v = sign * from.velocity;
  const double a = sign * from.acceleration;
  const double total = v + 0.5 * a * a / jerk;
  const double unlimited = std::sqrt(std::max(0.0, total * jerk));
  const double peak = std::min(unlimited, std::max(max_acceleration, -a));
  const double hold = peak > 0.0 ? (total - peak * peak / jerk) / peak : 0.0;
  return {std::max(0.0, (a + peak) / jerk), std::max(0.0, hold), peak / jerk, -sign * peak};
}

/// Pieces of constant jerk, one after the other.
class Pieces {
 public:
  Pieces(const State& from, GoalTime start) : state_(from), time_(start) {}

  void add(double duration, double jerk) {
    if (duration < kShortest) return;
    const GoalTime end = time_ + GoalTime{duration};
    const double length = (end - time_).count();
    const Polynomial polynomial{
        {state_.position, state_.velocity, 0.5 * state_.acceleration, jerk / 6.0, 0.0, 0.0}};
    pieces_.push_back({time_, end, polynomial});
    state_ = polynomial.state(length);
    time_ = end;
  }

  Path take() { return pieces_.empty() ? Path(state_.position) : Path(std::move(pieces_)); }

 private:
  State state_;
  GoalTime time_;
  std::vector<Piece> pieces_;
};

}  // namespace

Path jerk_limited_stop(const State& from, GoalTime start, const Braking& braking) {
  validate(braking);
  const double jerk = jerk_for(from, braking.max_acceleration / braking.ramp.count());
  const Profile p = profile(from, jerk, braking.max_acceleration);
  Pieces pieces(from, start);
  pieces.add(p.first, from.acceleration < p.peak ? jerk : -jerk);
  pieces.add(p.hold, 0.0);
  pieces.add(p.last, p.peak > 0.0 ? -jerk : jerk);
  return pieces.take();
}

}  // namespace interpolated_motion::trajectory
