#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "interpolated_motion_driver/axis/cyclic/setpoint_history.h"
#include "interpolated_motion_driver/axis/cyclic/way_back.h"
#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// A way of a drive back to its path.
struct Detour {
  double counts = 0.0;  ///< off the path, at most, from the newest target position on that it had
  HostDuration duration{};
};

/// The target positions of one drive, one for each SYNC.
///
/// The drive takes a target position at SYNC and reaches it one period later. So the target position sent
/// before the SYNC of instant s belongs to instant s + period: its stamp. Between two stamps the drive
/// interpolates, and it does so through the last few of them: a motion has been played to its end when all of
/// these are at the end.
///
/// Where the host was too late, or SYNC was left out, the drive has gone on along its polynomial and cannot
/// be called back: the target positions go on from there, and back to the path within the limits
/// (way_back()), or, in a stop, to rest.
///
/// A drive that does not answer SYNC may not have received them either. As long as it is not heard of it is
/// sent where it goes by itself, so that it does the same whether they arrive or not; then it is led back.
class SetpointStream {
 public:
  /// `limits` are what the joint brakes and comes back to its path within: velocity and acceleration must be
  /// finite.
  SetpointStream(const encoding::SetpointEncoding& encoding, const trajectory::JointLimits& limits);

  /// From the next target position on, rests at `counts`.
  void rest(std::int32_t counts);
  /// From the next target position on, follows `path`, its start at host time `begin`. Until then it rests at
  /// the start.
  void follow(const trajectory::Path& path, HostTime begin);
  /// Leaves the path at the newest target position and comes to rest within the limits: smoothly
  /// (trajectory::jerk_limited_stop), so that what the drive interpolates keeps the limit of acceleration,
  /// and harder where the limits of position leave no room for that.
  void brake();

  /// The target position to be sent for the SYNC that is due at `sync`; nothing if there has been one, or if
  /// `sync` is kNever. `heard`: the drive has answered the last SYNC that it had time to answer.
  std::optional<std::int32_t> next(HostTime sync, bool heard = true);
  /// The SYNCs that were due from `first` to `last` have not been sent: the drive has not taken the target
  /// positions that were for them. To be told before the next one is asked for.
  void leave_out(HostTime first, HostTime last);

  /// Instant that the newest target position belongs to.
  HostTime newest() const { return history_.newest(); }
  std::int32_t newest_counts() const { return counts_; }
  /// Velocity and acceleration with which the newest target position is passed; 0 at rest.
  trajectory::State newest_motion() const;
  /// Whether the drive has come to the end of the path at `now`.
  bool played(HostTime now) const;
  /// Instants for which the drive got no target position, since the host was too late or SYNC was left out.
  std::uint64_t missed() const { return missed_; }
  /// Whether the drive interpolates through target positions of its path alone. One that has gone on without
  /// some, and has not been led back, goes farther astray with each one more that is missing.
  bool is_led() const {
    return !is_unheard() && newest() >= back_at_ + static_cast<int>(interpolation::kCipHistory) * period_;
  }
  /// Whether the drive has gone so far astray that the limits allow no way back to the path. It goes on as it
  /// went until it is stopped.
  bool astray() const { return astray_; }
  /// The way back that was laid last, if it has not been taken yet.
  std::optional<Detour> take_detour() { return std::exchange(detour_, std::nullopt); }
  /// Forgets when the newest one was: what follows continues nothing.
  void restart() { history_.clear(); }

 private:
  GoalTime goal_time(HostTime when) const;
  bool rests_at(GoalTime time) const;
  bool rests_until(HostTime stamp) const;
  void lay(const trajectory::Path& path, HostTime begin);
  Departure departure(const trajectory::State& there, HostTime stamp) const;
  trajectory::Path stop_off_the_path(const trajectory::State& there, HostTime stamp) const;
  void come_back(HostTime stamp);
  void bridge(const trajectory::State& there, HostTime stamp);
  bool is_unheard() const { return unheard_from_ != kNever; }
  bool goes_unheard(HostTime sync, bool heard);
  std::int32_t target_at(HostTime stamp) const;
  std::int32_t further(HostTime stamp) const;

  encoding::SetpointEncoding encoding_;
  trajectory::JointLimits limits_;
  HostDuration period_;
  trajectory::Path path_;
  HostTime begin_{};
  std::optional<std::int32_t> rest_{0};
  bool braking_ = false;
  bool astray_ = false;
  std::optional<Detour> detour_;
  HostTime back_at_{};              ///< until then it is on its way back to the path
  HostTime unheard_from_ = kNever;  ///< SYNC of the first target position that may not have arrived
  int unheard_ = 0;                 ///< target positions sent since, at most
  SetpointHistory history_;
  std::int32_t counts_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace interpolated_motion::axis
