#pragma once

#include <array>
#include <cstddef>

namespace interpolated_motion::interpolation {

/// Highest order the document gives coefficients for, and the commands that order needs.
inline constexpr int kCipHighestOrder = 3;
inline constexpr std::size_t kCipHistory = kCipHighestOrder + 1;

/// A command and the time at which it is to be reached, s, on an axis of the caller's choice.
struct CipKnot {
  double time = 0.0;   ///< s
  double value = 0.0;  ///< in the unit of the commands
};

/// Command values, the newest first: P0, P-1, P-2, P-3.
using CipValues = std::array<double, kCipHistory>;
/// Commands, the newest first: those of t1, t0, t-1, t-2. Times strictly fall.
using CipKnots = std::array<CipKnot, kCipHistory>;

/// The fine interpolation polynomial of "Behavior models used in CIP Motion" (Rockwell MOTION-RM003I,
/// Fine Command Interpolation):
///
///     p(tau) = a0 + a1 tau + a2 tau^2 + a3 tau^3,   tau = t - t0,
///
/// which stands at the previous command at t0 (tau = 0), at the newest at t1 (tau = T), and passes through as
/// many older ones as its order takes. Beyond t1 the same polynomial extrapolates. Pure numbers: values in
/// the unit of the commands, times in s.
struct CipPolynomial {
  std::array<double, kCipHistory> a{};  ///< a0..a3, in the unit of the commands / s^i

  /// At `tau` s after t0: value, rate of change per s, and its rate per s^2. Any tau, beyond T too.
  double value(double tau) const { return a[0] + tau * (a[1] + tau * (a[2] + tau * a[3])); }
  double first_derivative(double tau) const { return a[1] + tau * (2 * a[2] + tau * 3 * a[3]); }
  double second_derivative(double tau) const { return 2 * a[2] + tau * 6 * a[3]; }
};

/// Position coefficients as the document tabulates them, for a constant controller update period `period` > 0
/// s. `order` 1..3; lower orders leave out the differences they have no history for. Only the first
/// `order` + 1 values of `p` are read.
CipPolynomial cip_position_polynomial(int order, double period, const CipValues& p);

/// Velocity coefficients b0..b2. `order` 1..2. The document prints "V" in b1 where the difference V0 - V-1 is
/// meant: with V itself the polynomial does not reach V0.
CipPolynomial cip_velocity_polynomial(int order, double period, const CipValues& v);

/// Acceleration coefficients c0 and c1; torque has the same.
CipPolynomial cip_acceleration_polynomial(double period, const CipValues& a);

/// The polynomial of `order` 1..3 through the first `order` + 1 knots, tau counted from the second knot's
/// time. The document assumes a constant period; this is the same polynomial for any times, by divided
/// differences, and with equal spacing it has the coefficients of the table.
CipPolynomial cip_polynomial_through(int order, const CipKnots& knots);

}  // namespace interpolated_motion::interpolation
