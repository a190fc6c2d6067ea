#pragma once

#include <array>

namespace interpolated_motion::trajectory {

/// Position (rad or m), velocity (1/s) and acceleration (1/s^2) of one joint at one instant.
struct State {
  double position = 0.0;      ///< rad or m
  double velocity = 0.0;      ///< per s, signed
  double acceleration = 0.0;  ///< per s^2, signed
};

/// Polynomial of degree <= 5 in local time t (s, from the start of its piece): sum of coefficients[i] * t^i.
struct Polynomial {
  std::array<double, 6> coefficients{};  ///< of t^0 .. t^5: rad or m per s^i

  /// Value and derivatives at local time `t`, s; not limited to the piece.
  double position(double t) const {
    const auto& c = coefficients;
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  }
  double velocity(double t) const {
    const auto& c = coefficients;
    return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])));
  }
  double acceleration(double t) const {
    const auto& c = coefficients;
    return 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]));
  }
  /// All three at local time `t`, s.
  State state(double t) const { return {position(t), velocity(t), acceleration(t)}; }
};

}  // namespace interpolated_motion::trajectory
