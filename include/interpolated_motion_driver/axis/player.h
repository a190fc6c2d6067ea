#pragma once

#include <optional>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What an enabled drive does: it is loaded, started, fed and stopped. Its power stage begins it, lets it
/// play and ends it; the other functions are those of Axis.
class Player {
 public:
  Player() = default;
  virtual ~Player() = default;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  // For the power stage.

  /// The drive has just been enabled.
  virtual void begin(HostTime now) = 0;
  /// Does what is due at `now`; as long as the drive is enabled.
  virtual void play(HostTime now) = 0;
  /// Of the enabled drive.
  virtual AxisState enabled_state() const = 0;
  /// The drive is moving, or may be for all that is known.
  virtual bool may_move() const = 0;
  /// How long it moves at most when it hears nothing more.
  virtual HostDuration longest_motion(HostTime now) const = 0;
  /// The drive is in fault or gone: nothing more is sent that would move it.
  virtual void give_up(HostTime now) = 0;

  // For the group.

  /// Called through Axis, which says what each of them does and owes the group. It is the caller who looks at
  /// the state: load() is for an axis in Ready, arm() for one in Loaded.
  virtual double rest_position() const = 0;
  virtual GoalTime start_lead() const = 0;
  virtual TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const = 0;
  virtual double record_bus_time() const = 0;
  virtual BusWatch bus_watch() const { return {}; }
  /// As Axis: Loading, Loaded; Moving; Stopping, then Ready. What fails on the way is a fault of the power
  /// stage.
  virtual void load(TailPtr tail, HostTime now) = 0;
  virtual void arm(HostTime begin, HostTime now) = 0;
  virtual HostTime path_begin() const = 0;
  virtual void stop(HostTime now) = 0;

  /// As Axis, for a path that changes while it is played.
  virtual Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const = 0;
  virtual GoalTime stream_lead() const = 0;
  virtual std::optional<GoalTime> committed() const = 0;
  virtual void hold(GoalTime until) = 0;
  virtual TailEncoderPtr encoder_behind(Pace pace) const = 0;
  /// Tells of a way on behind committed() where the drive would leave the joint's limits with what it makes
  /// of it. None: what the drive plays is within them where the path is.
  virtual trajectory::DemandCheck demand_check() const { return {}; }
  virtual bool can_follow(const Tail& tail) const = 0;
  virtual void follow(TailPtr tail) = 0;

  /// As Axis: what the drive plays, as its clock is known.
  virtual GoalTime playback(HostTime when) const = 0;
  virtual GoalTime goal_time_at(double drive_seconds) const = 0;
  virtual bool finished() const = 0;
  /// Sets what PowerStage::drive_status() does not.
  virtual void motion_status(HostTime now, AxisStatus& out) const = 0;
  virtual AxisReport report() const = 0;
};

}  // namespace interpolated_motion::axis
