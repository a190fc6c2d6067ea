#pragma once

#include "interpolated_motion_driver/emulation/plant_parameters.h"

namespace interpolated_motion::emulation {

/// The axis: actual position follows the demand as a critically damped second-order system, integrated
/// exactly for a demand that is linear within each millisecond. At constant velocity it is `lag_ms` behind.
class Plant {
 public:
  /// At rest at `position` (qc).
  Plant(const PlantParameters& parameters, double position);

  /// One millisecond under control; `demand` (qc) is that of its end. `velocity` (qc/ms) and `acceleration`
  /// (qc/ms^2) are fed forward: of a demand that moves so the axis is not behind.
  void follow(double demand, double velocity = 0.0, double acceleration = 0.0);

  /// The controller has been switched on or off: the axis stands, and a demand that follows starts here.
  void stand();

  /// Puts the axis at a position, at rest.
  void place(double position);

  /// While stalled the axis stays where it is, whatever the demand; free again it catches up from there.
  void set_stalled(bool stalled);
  /// The axis is to follow the demand plus so many qc, from the next step on.
  void set_load(double counts) { load_ = counts; }

  double position() const { return position_; }  ///< qc
  double velocity() const { return velocity_; }  ///< qc/ms

 private:
  double lag_;          ///< ms
  double rate_ = 0.0;   ///< 1/ms, natural frequency
  double decay_ = 0.0;  ///< exp(-rate_ * 1 ms)
  double load_ = 0.0;   ///< qc
  bool stalled_ = false;
  double demand_ = 0.0;  ///< qc, of the last millisecond, load included
  double position_ = 0.0;
  double velocity_ = 0.0;
};

}  // namespace interpolated_motion::emulation
