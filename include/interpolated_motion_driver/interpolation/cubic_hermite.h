#pragma once

#include <cstdint>

namespace interpolated_motion::interpolation {

/// Velocity of a motor in counts per ms, the unit the interpolator works in. `counts_per_revolution` > 0
/// (quadcounts).
inline double counts_per_ms(double rpm, double counts_per_revolution) {
  return rpm * counts_per_revolution / 60000.0;
}

/// Velocity of a motor in rpm from counts per ms.
inline double rpm(double counts_per_ms, double counts_per_revolution) {
  return counts_per_ms * 60000.0 / counts_per_revolution;
}

/// Acceleration of a motor in counts per ms^2 from rpm per s.
inline double counts_per_ms2(double rpm_per_second, double counts_per_revolution) {
  return counts_per_ms(rpm_per_second, counts_per_revolution) / 1000.0;
}

/// Acceleration of a motor in rpm per s from counts per ms^2.
inline double rpm_per_second(double counts_per_ms2, double counts_per_revolution) {
  return rpm(counts_per_ms2, counts_per_revolution) * 1000.0;
}

/// Position and velocity at one end of a segment.
struct HermiteKnot {
  double position = 0.0;  ///< counts
  double velocity = 0.0;  ///< counts/ms
};

/// One segment of maxon's Interpolated Position Mode ("EPOS3 Interpolated Position Mode", section 4.2.3): the
/// cubic
///
///     P(s) = a s^3 + b s^2 + c s + d,   s = t - t0 in [-T, 0], t0 at the END of the segment,
///
/// that leaves `P[n-1], V[n-1]` at s = -T and reaches `P[n], V[n]` at s = 0:
///
///     d = P[n],  c = V[n],
///     b = (-3 (P[n] - P[n-1]) + T (2 V[n] + V[n-1])) / T^2,
///     a = (-2 (P[n] - P[n-1]) + T (  V[n] + V[n-1])) / T^3.
///
/// The document prints a and b with n and n-1 exchanged; as printed the cubic misses its own start point.
/// Units: counts and ms.
class CubicHermite {
 public:
  /// `duration_ms` > 0.
  CubicHermite(HermiteKnot from, HermiteKnot to, double duration_ms)
      : c_(to.velocity), d_(to.position), duration_(duration_ms) {
    const double rise = to.position - from.position;
    b_ = (-3 * rise + duration_ * (2 * to.velocity + from.velocity)) / (duration_ * duration_);
    a_ = (-2 * rise + duration_ * (to.velocity + from.velocity)) / (duration_ * duration_ * duration_);
  }

  double duration() const { return duration_; }  ///< ms

  /// Values at `s` ms relative to the segment's end, in [-duration(), 0].
  double position(double s) const { return d_ + s * (c_ + s * (b_ + s * a_)); }  ///< counts
  double velocity(double s) const { return c_ + s * (2 * b_ + s * 3 * a_); }     ///< counts/ms
  double acceleration(double s) const { return 2 * b_ + s * 6 * a_; }            ///< counts/ms^2

  /// Values at drive sample `k`, k ms after the segment's start; sample duration() is the end.
  double position_at(std::int64_t k) const { return position(static_cast<double>(k) - duration_); }
  double velocity_at(std::int64_t k) const { return velocity(static_cast<double>(k) - duration_); }
  double acceleration_at(std::int64_t k) const { return acceleration(static_cast<double>(k) - duration_); }

  /// Exact maximum of |velocity| over the whole segment, counts/ms: at an end or at the vertex of the
  /// parabola.
  double peak_velocity() const;

  /// Exact maximum of |acceleration| over the whole segment, counts/ms^2: linear in s, so at an end.
  double peak_acceleration() const;

 private:
  double a_ = 0.0;
  double b_ = 0.0;
  double c_;
  double d_;
  double duration_;
};

}  // namespace interpolated_motion::interpolation
