#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/error_limits.h"
#include "interpolated_motion_driver/emulation/silverdust/interpolated_move.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"
#include "interpolated_motion_driver/emulation/silverdust/profile.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"
#include "interpolated_motion_driver/emulation/silverdust/segment_queue.h"

namespace interpolated_motion::emulation {

/// The trajectory generator: which motion moves the target position, from its start to its end ("SilverLode
/// User Manual", motion control; Command Reference, MAV, MRV, VMI, STP, ZTP, TTP). One motion at a time; one
/// that begins takes over from the one before at the velocity there is. At its end bit 13 of the polling
/// status word is set and the delay of the holding limit begins.
///
/// Accelerations are in units of which 2^31 are `acceleration_full_scale` rpm per tick, velocities in units
/// of which 2^31 are `velocity_full_scale_rpm`.
class MotionControl {
 public:
  /// Works on what it is given, which must outlive it; the segments of an IMS come from `registers` or from
  /// `queue`.
  MotionControl(const SilverDustParameters& parameters, RegisterFile& registers, SegmentQueue& queue,
                PollingStatus& status, ErrorLimits& limits);

  /// As after power-up: no motion, the target at 0.
  void restart();

  /// Puts the target at `counts`, at rest, whatever was commanded (ZTP, TTP); a motion is not ended by that.
  void place(std::int64_t counts) { profile_.place(counts); }

  /// MAV and MRV: to `goal`, counts, at a speed of up to `velocity`, >= 0, with `acceleration`, >= 0.
  void move_to(std::int32_t goal, std::int64_t acceleration, std::int64_t velocity);

  /// VMI: to `velocity`, signed, with `acceleration`, >= 0; goes on until something else ends it.
  void run_at(std::int64_t velocity, std::int64_t acceleration);

  /// IMS: begins in the next tick.
  void interpolate();

  /// Registers 18 or 20..23 have been written while interpolating().
  void follow_registers() { interpolation_.follow_registers(); }

  /// STP: brakes to rest with `deceleration`, > 0; with 0 as the motion that runs accelerates.
  void stop(std::int64_t deceleration);

  /// STP -1: the motion ends at once and the target stands at `counts`.
  void stop_at(std::int64_t counts);

  /// Kill motor recovery: the target stands where it is, and a motion has ended.
  void freeze();

  /// One servo tick: the target moves.
  void tick();

  /// A motion runs.
  bool active() const { return motion_ != Motion::None; }

  /// It is an IMS operation.
  bool interpolating() const { return motion_ == Motion::Interpolated; }

  /// The target: position and velocity.
  const ProfileGenerator& target() const { return profile_; }

  /// The IMS operation, the last one when none runs.
  const InterpolatedMove& interpolation() const { return interpolation_; }

 private:
  enum class Motion { None, Interpolated, Profile };

  void end();
  std::int64_t profile_step(std::int64_t acceleration) const;

  const int acceleration_full_scale_;
  PollingStatus& status_;
  ErrorLimits& limits_;
  ProfileGenerator profile_;
  InterpolatedMove interpolation_;
  Motion motion_ = Motion::None;
  std::int64_t step_ = 0;  // of the running profile, fractions of a velocity unit per tick
};

}  // namespace interpolated_motion::emulation
