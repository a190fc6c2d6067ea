#pragma once

#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The target positions of one drive, one for each SYNC.
///
/// The drive takes a target position at SYNC and reaches it one period later. So the target position sent
/// before the SYNC of instant s belongs to instant s + period: its stamp. Between two stamps the drive
/// interpolates, and it does so through the last few of them: a motion has been played to its end when all of
/// these are at the end.
class SetpointStream {
 public:
  /// `order`: of the drive's fine interpolation.
  SetpointStream(const encoding::Transmission& transmission, HostDuration period, int order)
      : transmission_(transmission), period_(period), order_(order) {}

  /// From the next target position on, rests at `counts`.
  void rest(std::int32_t counts);
  /// From the next target position on, follows `path`, its start at host time `begin`. Until then it rests at
  /// the start.
  void follow(const trajectory::Path& path, HostTime begin);
  /// Leaves the path at the newest target position and comes to rest within `limits`: smoothly
  /// (trajectory::stop_path), or as short as possible where that would leave the limits of position.
  void brake(const trajectory::JointLimits& limits);

  /// The target position to be sent for the SYNC that is due at `sync`; nothing if there has been one, or if
  /// `sync` is kNever.
  std::optional<std::int32_t> next(HostTime sync);

  /// Instant that the newest target position belongs to.
  HostTime newest() const { return newest_; }
  std::int32_t newest_counts() const { return counts_; }
  /// Whether the drive has come to the end of the path at `now`.
  bool played(HostTime now) const;
  /// Instants for which there was no target position, since the host was too late.
  std::uint64_t missed() const { return missed_; }
  /// Forgets when the newest one was: what follows continues nothing.
  void restart() { newest_ = HostTime{}; }

 private:
  GoalTime goal_time(HostTime when) const;

  encoding::Transmission transmission_;
  HostDuration period_;
  int order_;
  trajectory::Path path_;
  HostTime begin_{};
  std::optional<std::int32_t> rest_{0};
  HostTime newest_{};
  std::int32_t counts_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace interpolated_motion::axis
