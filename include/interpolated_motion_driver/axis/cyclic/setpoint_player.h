#pragma once

#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/axis/cia402/power_stage.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_device.h"
#include "interpolated_motion_driver/axis/cyclic/setpoint_plan.h"
#include "interpolated_motion_driver/axis/player.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::axis {

/// Plays paths on a CiA 402 drive in the cyclic synchronous position mode (mode 8).
///
/// From the moment it is enabled the drive gets one target position per SYNC, at rest as well, and
/// interpolates between them by itself. A goal's way: its encoder executes its target positions as the drive
/// will and holds them against the path; load() has nothing to load; from arm() on the target positions are
/// those of the path. stop() leaves the path for one to rest within the joint's limits. When target positions
/// fail to come the drive goes on along its polynomial for a few periods and then faults: a host that stalls
/// or dies stops the drive so.
class SetpointPlayer final : public Player {
 public:
  /// `stage` and `drive`, its device, must outlive the player.
  SetpointPlayer(Cia402PowerStage& stage, CyclicDevice& drive) : stage_(stage), drive_(drive) {}

  /// Sends the target position of the next SYNC, when the drive is to have one: right behind the SYNC before,
  /// and to a drive that has not answered the last one again, shortly before.
  void send_target(HostTime now);
  /// When the latter is due; kNever: it is not.
  HostTime repeat_due() const;

  void begin(HostTime now) override;
  void play(HostTime now) override;
  AxisState enabled_state() const override;
  bool may_move() const override { return phase_ == Phase::Moving || phase_ == Phase::Braking; }
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;

  double rest_position() const override;
  GoalTime start_lead() const override;
  TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const override;
  double record_bus_time() const override { return drive_.parameters().record_bus_time; }
  void load(TailPtr tail, HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override;
  void stop(HostTime now) override;

  Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const override;
  GoalTime stream_lead() const override;
  std::optional<GoalTime> committed() const override;
  void hold(GoalTime until) override;
  TailEncoderPtr encoder_behind(Pace pace) const override;
  trajectory::DemandCheck demand_check() const override;
  bool can_follow(const Tail& tail) const override;
  void follow(TailPtr tail) override;

  GoalTime playback(HostTime when) const override;
  /// The drive follows SYNC, so its clock is the host's.
  GoalTime goal_time_at(double drive_seconds) const override {
    return path_.start_time() + GoalTime{drive_seconds};
  }
  bool finished() const override { return finished_; }
  void motion_status(HostTime now, AxisStatus& out) const override;
  AxisReport report() const override;

 private:
  enum class Phase {
    Off,        ///< the drive is not enabled
    Following,  ///< waits until the drive follows its target positions
    Ready,
    Loading,
    Loaded,
    Moving,
    Braking,
  };

  bool send(std::int32_t target);
  void tell(const Detour& detour, HostTime now);
  void poll_following(HostTime now);
  void poll_moving(HostTime now);
  void come_to_rest(HostTime now);
  void enter(Phase phase, HostTime now);

  Cia402PowerStage& stage_;
  CyclicDevice& drive_;
  Phase phase_ = Phase::Off;
  std::int32_t rest_counts_ = 0;

  trajectory::Path path_;
  std::optional<HostTime> stream_origin_;  ///< host time of goal time 0, for a stream
  HostTime begin_ = kNever;
  HostTime origin_{};                ///< of goal time 0, once begin_ is known
  HostTime held_ = HostTime::min();  ///< of hold()
  bool finished_ = false;

  HostTime sent_for_ = kNever;  ///< SYNC of the newest target position
  bool repeated_ = true;        ///< that is not to be sent again
  std::uint64_t sent_ = 0;
  std::uint64_t sent_at_load_ = 0;
  std::uint64_t missed_at_load_ = 0;
  std::optional<AxisReport> report_;  ///< of a motion that has ended: target positions go on at rest
  std::uint64_t refused_ = 0;         ///< target positions that the queue of the bus did not take
};

}  // namespace interpolated_motion::axis
