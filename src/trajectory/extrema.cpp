#include "interpolated_motion_driver/trajectory/extrema.h"

#include <array>
#include <cstddef>

namespace interpolated_motion::trajectory {

namespace {

/// The polynomial in x = (t - from) / length, so that the interval asked for is [0, 1].
Coefficients<5> on_unit_interval(const Polynomial& polynomial, double from, double length) {
  Coefficients<5> c = polynomial.coefficients;
  if (from != 0.0) {
    for (std::size_t done = 0; done < 5; ++done) {
      for (std::size_t i = 5; i-- > done;) c[i] += from * c[i + 1];
    }
  }
  double power = 1.0;
  for (double& coefficient : c) {
    coefficient *= power;
    power *= length;
  }
  return c;
}

void include(Range& range, double time, double value) {
  if (value < range.minimum.value) range.minimum = {time, value};
  if (value > range.maximum.value) range.maximum = {time, value};
}

/// Range of `value` over [from, to], given where its slope changes sign on the unit interval.
template <class Value, std::size_t Degree>
Range range_of(const Value& value, const Roots<Degree>& turns, double from, double to) {
  Range range{{from, value(from)}, {from, value(from)}};
  for (const double turn : turns) {
    const double time = from + turn * (to - from);
    include(range, time, value(time));
  }
  include(range, to, value(to));
  return range;
}

}  // namespace

Roots<4> position_turns(const Polynomial& polynomial, double from, double to) {
  Roots<4> turns;
  for (const double turn : sign_changes<4>(derivative<5>(on_unit_interval(polynomial, from, to - from))))
    turns.add(from + turn * (to - from));
  return turns;
}

Range position_range(const Polynomial& polynomial, double from, double to) {
  const auto velocity = derivative<5>(on_unit_interval(polynomial, from, to - from));
  return range_of([&](double t) { return polynomial.position(t); }, sign_changes<4>(velocity), from, to);
}

Range velocity_range(const Polynomial& polynomial, double from, double to) {
  const auto acceleration = derivative<4>(derivative<5>(on_unit_interval(polynomial, from, to - from)));
  return range_of([&](double t) { return polynomial.velocity(t); }, sign_changes<3>(acceleration), from, to);
}

Range acceleration_range(const Polynomial& polynomial, double from, double to) {
  const auto jerk =
      derivative<3>(derivative<4>(derivative<5>(on_unit_interval(polynomial, from, to - from))));
  return range_of([&](double t) { return polynomial.acceleration(t); }, sign_changes<2>(jerk), from, to);
}

}  // namespace interpolated_motion::trajectory
