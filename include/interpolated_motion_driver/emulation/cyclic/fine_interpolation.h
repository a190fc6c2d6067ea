#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/emulation/motion_state.h"

namespace interpolated_motion::emulation {

/// Fine interpolation of the emulated cyclic drive: from updates at the rate of its host to a demand at any
/// time, by the polynomial through the last updates ("Behavior models used in CIP Motion", Fine Command
/// Interpolation), evaluated by Neville's scheme. Positions in counts; times in ms of the drive's own clock.
///
/// An update that comes at its place on the grid of updates is reached one period later. The grid follows the
/// arrivals slowly, so their jitter does not shake the motion; an update up to half a period off is still
/// taken for the right one, at once.
class FineInterpolation {
 public:
  /// Stands at `position` until the first update.
  void enter(double position);

  /// `period` T > 0 ms, `gain` in (0, 1]: share of an arrival's deviation the grid follows.
  void set_grid(double period, double gain);
  /// 1..3.
  void set_order(int order) { order_ = static_cast<std::size_t>(order); }

  /// A fresh position has come at `now`. Two within one period: the later one counts.
  void update(double position, double now);

  /// What goes with the newest update: velocity (counts/ms) and torque, in the caller's unit. Interpolated by
  /// polynomials of their own, of order 2 (or the position's, if lower) and 1.
  void feed_forward(double velocity, double torque);

  /// Whether an update has come since enter().
  bool following() const { return following_; }

  /// Updates that have not come, to the nearest: between the last two, and up to `now`.
  std::uint32_t missed_in_all() const { return missed_; }
  std::uint32_t missed_now(double now) const;  ///< 0 before the first

  /// Whether `now` lies more than `updates` periods beyond the newest.
  bool beyond(int updates, double now) const;

  /// Demand at `now`.
  MotionState at(double now) const;
  double velocity_at(double now) const;  ///< counts/ms, as fed forward
  double torque_at(double now) const;    ///< as fed forward

 private:
  struct Knot {
    double time = 0.0;      ///< ms of the drive's own clock, at which `position` is to be reached
    double position = 0.0;  ///< counts
    double velocity = 0.0;  ///< counts/ms, fed forward
    double torque = 0.0;    ///< fed forward
  };

  // Four for a cubic, and one more for the segment that is still in effect when an update comes early.
  static constexpr std::size_t kKnots = 5;

  void shift_in(const Knot& knot);
  MotionState through(double Knot::*value, std::size_t order, double now) const;

  double period_ = 1.0;
  double gain_ = 1.0;
  std::size_t order_ = 3;
  bool following_ = false;
  std::uint32_t missed_ = 0;
  std::array<Knot, kKnots> knots_{};  // the newest first
};

}  // namespace interpolated_motion::emulation
