#pragma once

#include <cstdint>

#include "interpolated_motion_driver/encoding/ims/ims_encoding.h"
#include "interpolated_motion_driver/encoding/ims/tick_samples.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"
#include "interpolated_motion_driver/interpolation/ims_segment.h"

namespace interpolated_motion::encoding {

/// What every segment has to keep, in the drive's units and ticks, and the path in counts.
struct ImsRules {
  /// Limits rounded down to whole units, of an encoding that is valid (not checked here).
  explicit ImsRules(const ImsEncoding& encoding);

  interpolation::ImsScale scale;  ///< of the encoding, as ImsEncoding::law() gives it
  double counts_per_unit;         ///< that a velocity of one unit moves in a tick
  double lag;                     ///< ticks, see ImsScale::position_lag
  double bound;                   ///< counts
  std::int64_t max_velocity;      ///< units
  std::int64_t max_step;          ///< units per tick, change of the velocity
  std::int64_t min_ticks;         ///< of a segment
  std::int64_t max_ticks;         ///< of a segment
};

/// A segment before it is written in the drive's numbers.
struct ImsMove {
  std::int64_t ticks = 0;     ///< duration
  std::int64_t velocity = 0;  ///< units, signed: to ramp to; of a segment that lands, the greatest allowed
  std::int64_t step = 0;      ///< units per tick; 0: constant velocity
  bool lands = false;         ///< comes to a halt on the path's final position
  std::int64_t target = 0;    ///< counts, where it lands
};

/// What executing one segment gives.
struct ImsFigures {
  double deviation = 0.0;          ///< counts, worst of the segment's ticks
  std::int64_t peak_velocity = 0;  ///< units
  std::int64_t peak_step = 0;      ///< units per tick

  /// Whether all three are within the rules.
  bool keep(const ImsRules& rules) const {
    return deviation <= rules.bound && peak_velocity <= rules.max_velocity && peak_step <= rules.max_step;
  }
};

/// The move that takes `ticks` at a constant acceleration (counts/tick^2) nearest to that given. Velocities
/// do not change sign within it.
ImsMove plan_ramp(const ImsRules& rules, const interpolation::ImsState& from, std::int64_t ticks,
                  double acceleration);

/// The move that brakes from `from` at once and lands on `target` (counts): false if that is behind, needs
/// more than the greatest acceleration or more time than a segment has. It goes on until tick `end` of the
/// path, if a segment can.
bool plan_landing(const ImsRules& rules, std::int64_t ticks_to_end, const interpolation::ImsState& from,
                  std::int64_t target, ImsMove& move);

/// The move from rest onto `target`, a few counts away.
ImsMove plan_settling(const ImsRules& rules, std::int64_t ticks_to_end, const interpolation::ImsState& from,
                      std::int64_t target);

/// The move in the drive's numbers.
ImsSegment segment_of(const ImsRules& rules, const interpolation::ImsState& from, const ImsMove& move);

/// Executes the move from `from` at `tick` as the drive does, compares every tick with the path, and tells
/// where it leads. The ticks must be readable. False if the drive would not execute it as planned: would
/// brake for the position it is only projected to, or not land in time.
bool execute(const ImsRules& rules, const TickSamples& samples, std::int64_t tick,
             const interpolation::ImsState& from, const ImsMove& move, interpolation::ImsState& end,
             ImsFigures& figures);

}  // namespace interpolated_motion::encoding
