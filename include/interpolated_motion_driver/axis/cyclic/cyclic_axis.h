#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/cia402_axis.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/axis/cyclic/telemetry.h"
#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

namespace interpolated_motion::axis {

/// A CiA 402 drive in the cyclic synchronous position mode (mode 8) on an isochronous CANopen bus.
///
/// From the moment it is enabled the drive gets one target position per SYNC, at rest as well, and
/// interpolates between them by itself. A goal's way: plan() executes its target positions as the drive will
/// and holds them against the path; load() has nothing to load; from arm() on the target positions are those
/// of the path. stop() leaves the path for one to rest within the joint's limits. When target positions fail
/// to come the drive goes on along its polynomial for a few periods and then faults: a host that stalls or
/// dies stops the drive so.
class CyclicAxis : public Cia402Axis {
 public:
  /// `master`, which must be isochronous with the same period, and `node` must outlive the axis. Throws
  /// std::invalid_argument, naming joint, parameter, value and range.
  CyclicAxis(CyclicAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node);

  std::string description() const override;
  void poll(HostTime now) override;

  double rest_position() const override;
  GoalTime start_lead() const override;
  std::optional<Refusal> plan(const trajectory::Path& path, GoalTime wait) override;
  /// None: target positions go to the bus at rest as well, so no goal adds to what the bus carries.
  std::vector<RecordSlot> record_slots() const override { return {}; }
  double record_bus_time() const override { return parameters_.record_bus_time; }
  void load(HostTime now) override;
  void arm(HostTime begin, HostTime now) override;
  HostTime path_begin() const override;
  void stop(HostTime now) override;

  std::optional<Refusal> plan_stream(HostTime origin, GoalTime rest) override;
  GoalTime stream_lead() const override;
  HostTime committed() const override;
  std::optional<Refusal> plan_follow(const trajectory::Path& path) override;
  void follow() override;

  GoalTime playback(HostTime when) const override;
  /// The drive follows SYNC, so its clock is the host's.
  GoalTime goal_time_at(double drive_seconds) const override {
    return path_.start_time() + GoalTime{drive_seconds};
  }
  bool finished() const override { return finished_; }
  const AxisFeedback& feedback() const override { return feedback_; }
  void status(HostTime now, AxisStatus& out) const override;
  AxisReport report() const override;

 private:
  /// Of the enabled drive.
  enum class Phase {
    Off,        ///< it is not enabled
    Following,  ///< waits until the drive follows its target positions
    Ready,
    Loading,
    Loaded,
    Moving,
    Braking,
  };

  std::vector<SdoSequence::Step> bring_up_steps() override;
  bool has_reported(HostTime since) const override { return telemetry_.status_time > since; }
  void on_started() override;
  void on_mode_selected() override;
  void on_enabling() override;
  void on_enabled(HostTime now) override;
  void poll_enabled(HostTime now) override;
  AxisState enabled_state() const override;
  bool is_motion_phase() const override { return phase_ == Phase::Moving || phase_ == Phase::Braking; }
  HostDuration longest_motion(HostTime now) const override;
  void give_up(HostTime now) override;
  void press_stop(HostTime now) override;
  CyclicTelemetry& drive() override { return telemetry_; }
  const CyclicTelemetry& drive() const override { return telemetry_; }
  std::string text_of(const canopen::Emcy& emcy) const override;
  std::string lost_by_restart() const override { return "its settings"; }

  void poll_following(HostTime now);
  void poll_moving(HostTime now);
  void poll_braking(HostTime now);

  void on_tpdo(int number, const canopen::Frame& frame, HostTime time);
  bool wants_targets() const;
  void send_target();
  void come_to_rest(HostTime now);

  Phase phase() const { return enabled() ? phase_ : Phase::Off; }
  void enter_phase(Phase phase, HostTime now);
  encoding::SetpointEncoding encoding() const;
  double sync_delay() const { return master().sync_timing().delay(); }

  CyclicAxisParameters parameters_;
  SetpointStream setpoints_;
  cia402::Identity identity_;
  CyclicTelemetry telemetry_;
  AxisFeedback feedback_;

  Phase phase_ = Phase::Off;

  std::int32_t rest_counts_ = 0;
  trajectory::Path planned_;
  std::optional<HostTime> planned_origin_;  ///< host time of goal time 0, for a stream
  trajectory::Path path_;
  std::optional<HostTime> stream_origin_;
  HostTime begin_ = kNever;
  bool finished_ = false;

  std::uint64_t sent_ = 0;
  std::uint64_t sent_at_load_ = 0;
  std::uint64_t missed_at_load_ = 0;
  std::uint64_t refused_ = 0;  ///< target positions that the queue of the bus did not take
};

}  // namespace interpolated_motion::axis
