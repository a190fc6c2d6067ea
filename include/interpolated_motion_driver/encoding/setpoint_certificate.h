#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/cip_polynomial.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

/// How a path goes to a drive in the cyclic synchronous position mode (CiA 402, mode 8): as target positions
/// in whole counts, one per `period`, between which the drive interpolates to its servo rate ("Behavior
/// models used in CIP Motion", Fine Command Interpolation).
struct SetpointEncoding {
  std::string joint;
  Transmission transmission;
  GoalTime period{0.010};       ///< between target positions, > 0
  int order = 3;                ///< of the drive's fine interpolation, 1..3
  GoalTime servo_period{1e-3};  ///< between the drive's samples, 0 < servo_period <= period
  double bound_counts = 5.0;    ///< largest deviation from the path at any sample of the drive
  /// Largest acceleration of the drive's demand, per s^2, from sample to sample. A drive that interpolates on
  /// a line (order 1) has steps in velocity by nature: there it means nothing.
  double max_acceleration = std::numeric_limits<double>::infinity();
};

/// What the drive will make of a path.
struct SetpointCertificate {
  double worst_deviation = 0.0;  ///< counts, at the drive's samples
  GoalTime worst_time{0.0};      ///< when it occurs, in the path's time
  double acceleration = 0.0;     ///< largest of the demand, per s^2; see demand_acceleration()
};

/// The target position, counts, for goal time `time`: rounded, and cut off at the ends of 32 bits.
std::int32_t setpoint_at(const trajectory::Path& path, const Transmission& transmission, GoalTime time);

/// Executes the target positions of `path` as the drive will, from a rest of several periods before the path
/// to one behind it, and compares each sample of the drive with the path. Where the instants of the target
/// positions fall within the path is known only when it starts, so `kSetpointPhases` positions of them are
/// tried, evenly spread over the period. Refused: a deviation above the bound or an acceleration above the
/// largest, with what to do; a position beyond 32 bits; values that are not finite. `encoding` out of its
/// ranges throws std::invalid_argument.
Expected<SetpointCertificate, Refusal> certify_setpoints(const trajectory::Path& path,
                                                         const SetpointEncoding& encoding);

/// The same for the rest of a path that the drive comes along already: only target positions from `first` on,
/// a goal time within the path, and what the drive makes of them.
Expected<SetpointCertificate, Refusal> certify_setpoints_from(GoalTime first, const trajectory::Path& path,
                                                              const SetpointEncoding& encoding);

/// The same of a stream's way on, whose target positions are known to be at `first` and whole periods after
/// it. Only the deviation is held against its bound; what is refused is so for `stream_deviation_bound`.
Expected<SetpointCertificate, Refusal> certify_stream_from(GoalTime first, const trajectory::Path& path,
                                                           const SetpointEncoding& encoding);

/// Largest acceleration, per s^2, of what the drive makes of target positions that follow `path` exactly, not
/// rounded to counts: by differences of its demand from servo sample to servo sample, between the target
/// positions at `first` and those behind the path. `encoding` must be valid.
double demand_acceleration(const trajectory::Path& path, GoalTime first, const SetpointEncoding& encoding);

/// The same of a drive that goes on from `known`, the target positions that it has, the newest first, at
/// times of `way_on` in s that need not be a period apart. The next ones are those of `way_on` at `next`,
/// later than all of `known`, and from there on a period apart; what the drive makes of those up to `until`
/// counts, the step of its demand where the first takes effect too. 0 for order 1, where an acceleration
/// means nothing.
double demand_acceleration(interpolation::CipKnots known, GoalTime next, GoalTime until,
                           const trajectory::Path& way_on, const SetpointEncoding& encoding);

/// How far, in counts, the drive is off `path` at most at its samples while it goes on from `known` and then
/// comes along `way_on`, both as above; its target positions are whole counts.
double demand_departure(interpolation::CipKnots known, GoalTime next, GoalTime until,
                        const trajectory::Path& way_on, const trajectory::Path& path,
                        const SetpointEncoding& encoding);

/// An acceleration of what a drive makes of its target positions.
struct AccelerationPeak {
  GoalTime time{0.0};         ///< of the target position behind which it occurs
  double acceleration = 0.0;  ///< magnitude, per s^2
};

/// The first acceleration beyond `encoding.max_acceleration` when the drive leaves the path `before` for
/// `way_on` where that starts. `known`: the instant of a target position, not later; what the drive makes of
/// those up to the start of `way_on` is not judged. Nothing where it keeps that, and for order 1, where an
/// acceleration means nothing. `encoding` must be valid.
std::optional<AccelerationPeak> find_acceleration_beyond(const trajectory::Path& before, GoalTime known,
                                                         const trajectory::Path& way_on,
                                                         const SetpointEncoding& encoding);

/// Positions of the target instants within the path that certify_setpoints() tries.
inline constexpr int kSetpointPhases = 4;

}  // namespace interpolated_motion::encoding
