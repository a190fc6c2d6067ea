#pragma once

#include <cstdint>

#include "interpolated_motion_driver/interpolation/ims_segment.h"

namespace interpolated_motion::interpolation {

/// What the numbers of an IMS segment mean ("Interpolated Motion", QCI-TD044). The law works in velocity
/// units, of which 2^31 are the velocity's full scale, and adds them up tick by tick, so it is exact in
/// integers whatever the encoder; one factor makes counts of the sum. At 4000 counts per revolution a count
/// is 2^26 units.
struct ImsScale {
  double counts_per_revolution = 4000.0;    ///< of the encoder on the motor, > 0
  double velocity_full_scale_rpm = 4000.0;  ///< velocity of 2^31
  /// Acceleration of 2^31, rpm per tick. The document says 2000 and its worked example closes only with it;
  /// the drive's other commands use 4000. The velocity's full scale must be a whole multiple of it.
  double acceleration_full_scale_rpm_per_tick = 2000.0;
  double tick = 120e-6;  ///< s, the drive's servo cycle
  /// By how much of a tick the position lags behind the sum of the velocities, 0..1: 0 if the drive updates
  /// the velocity before the position, 1 if after, 0.5 if it moves as with constant acceleration in between.
  /// The document does not say; half-way is wrong by half a tick of time at worst, and by nothing at rest.
  double position_lag = 0.5;

  double counts_per_unit() const;  ///< counts that a velocity of one unit moves in a tick
  double units_per_count() const { return 1.0 / counts_per_unit(); }  ///< of the sum that are one count
  double units_per_rpm() const;  ///< of the velocity that are 1 rpm of the motor
  /// Value of a segment's acceleration that changes the velocity by one unit in a tick; 2 at the default
  /// scales. The law drops the fraction of an acceleration that is not a multiple of it.
  std::int64_t acceleration_per_step() const;

  /// Throws std::invalid_argument with parameter, value and allowed range.
  void validate() const;
};

/// Where the drive's profile generator stands after a tick, in its own integers.
struct ImsState {
  std::int64_t sum = 0;       ///< of the velocities of all ticks, units; does not wrap around
  std::int64_t velocity = 0;  ///< units, signed
};

/// Exact: whole numbers, and both are the drive's own.
inline bool operator==(const ImsState& a, const ImsState& b) {
  return a.sum == b.sum && a.velocity == b.velocity;
}
inline bool operator!=(const ImsState& a, const ImsState& b) { return !(a == b); }

/// At rest on a count, which may lie outside the 32 bits of the drive's register.
ImsState ims_at_rest(const ImsScale& scale, std::int64_t counts);

/// Demand position, counts, not rounded.
double ims_counts(const ImsScale& scale, const ImsState& state);

/// The count nearest to the demand position.
std::int64_t ims_nearest_count(const ImsScale& scale, const ImsState& state);

/// The part of `counts` that a 32-bit register holds.
std::int32_t ims_register(std::int64_t counts);

/// `ticks` (>= 0) after `from`: the velocity moves by `step` (>= 0 units) a tick to `velocity` and holds
/// there; with a step of 0 it stays. Closed form of the law wherever the drive does not brake for a position.
ImsState ramp_and_hold(const ImsState& from, std::int64_t velocity, std::int64_t step, std::int64_t ticks);

/// Units covered by ticks of velocity, velocity - step, velocity - 2 step, ... while positive. `velocity` up
/// to 2^31, `step` >= 1.
std::int64_t stopping_sum(std::int64_t velocity, std::int64_t step);

/// Greatest velocity whose stopping_sum() is at most `distance` units; 0 if `distance` is not positive.
std::int64_t greatest_landing_velocity(std::int64_t distance, std::int64_t step);

/// Executes IMS segments tick by tick, as the drive does.
///
/// Each tick the velocity (positive towards the segment's position) moves by at most one step, the segment's
/// acceleration, towards the segment's velocity, and is then added to the sum. It is the greatest such
/// velocity from which braking at one step a tick still ends at the position or before it. So a segment that
/// is projected 2^30 counts ahead never brakes, and one that comes to a halt holds its velocity until the
/// stopping distance reaches the distance left, brakes, and lands on the position exactly. It never passes
/// the position: where braking begins too late for the acceleration, the last ticks brake harder. (That of
/// the document's worked example is too weak by 0.014 counts, as its acceleration loses a fraction.)
/// Acceleration 0 keeps the velocity. Direction and distance come from the difference to the present position
/// in 32 bits.
class ImsProfile {
 public:
  /// Stands at `state`; load() a segment before tick(). `scale` must be valid.
  ImsProfile(const ImsScale& scale, const ImsState& state);

  /// Begins a segment where the state stands.
  void load(const ImsSegment& segment);

  /// One servo tick.
  void tick();

  /// After the latest tick.
  const ImsState& state() const { return state_; }

  /// Whether `ticks` of the segment loaded pass without braking for its position, so that ramp_and_hold()
  /// tells where they lead. May say no for a segment that only nearly brakes.
  bool runs_free(std::int64_t ticks) const;

 private:
  ImsScale scale_;
  ImsState state_;
  std::int64_t direction_ = 1;  ///< +1 or -1, from the segment's position
  std::int64_t target_ = 0;     ///< the segment's position as a sum of units
  std::int64_t velocity_ = 0;   ///< the segment's, units
  std::int64_t step_ = 0;       ///< the segment's acceleration, units per tick
};

}  // namespace interpolated_motion::interpolation
