#pragma once

#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/trajectory/roots.h"

namespace interpolated_motion::trajectory {

/// A value of a polynomial and the local time (s) at which it occurs.
struct Extremum {
  double time = 0.0;   ///< s since the start of the piece
  double value = 0.0;  ///< rad or m, per s or per s^2, as the quantity is
};

/// Smallest and largest value over an interval; at equal values the earliest found.
struct Range {
  Extremum minimum;  ///< not above any value over the interval
  Extremum maximum;  ///< not below any value over the interval
};

/// Local times within [from, to] at which the position of a polynomial turns, ascending: between neighbours,
/// and the ends, it is monotone.
Roots<4> position_turns(const Polynomial& polynomial, double from, double to);

/// Exact range of the position, velocity or acceleration of a polynomial over local times [from, to], `from`
/// <= `to`: the ends and every root of the derivative between them, isolated by the roots of the next
/// derivative, so none is missed. Exact to rounding; no allocation.
Range position_range(const Polynomial& polynomial, double from, double to);
Range velocity_range(const Polynomial& polynomial, double from, double to);
Range acceleration_range(const Polynomial& polynomial, double from, double to);

}  // namespace interpolated_motion::trajectory
