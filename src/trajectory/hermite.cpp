#include "interpolated_motion_driver/trajectory/hermite.h"

namespace interpolated_motion::trajectory {

Polynomial cubic_hermite(const State& from, const State& to, double duration) {
  const double inverse = 1.0 / duration;
  const double mean = (to.position - from.position) * inverse;
  const double c2 = (3.0 * mean - 2.0 * from.velocity - to.velocity) * inverse;
  const double c3 = (from.velocity + to.velocity - 2.0 * mean) * inverse * inverse;
  return {{from.position, from.velocity, c2, c3, 0.0, 0.0}};
}

Polynomial quintic_hermite(const State& from, const State& to, double duration) {
  const double inverse = 1.0 / duration;
  const double mean = (to.position - from.position) * inverse;
  const double bend_from = 0.5 * from.acceleration * duration;
  const double bend_to = 0.5 * to.acceleration * duration;
  const double i2 = inverse * inverse;
  const double c3 = (10.0 * mean - 6.0 * from.velocity - 4.0 * to.velocity - 3.0 * bend_from + bend_to) * i2;
  const double c4 =
      (-15.0 * mean + 8.0 * from.velocity + 7.0 * to.velocity + 3.0 * bend_from - 2.0 * bend_to) * i2 *
      inverse;
  const double c5 = (6.0 * mean - 3.0 * (from.velocity + to.velocity) - bend_from + bend_to) * i2 * i2;
  return {{from.position, from.velocity, 0.5 * from.acceleration, c3, c4, c5}};
}

Polynomial least_jerk(const State& from, const State& to, double duration) {
  const double mean = (to.position - from.position) / duration;
  const double velocities = 60.0 * mean - 24.0 * from.velocity - 36.0 * to.velocity;
  State end = to;
  end.acceleration = (from.acceleration - velocities / (3.0 * duration)) / 3.0;
  return quintic_hermite(from, end, duration);
}

}  // namespace interpolated_motion::trajectory
