#pragma once

#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/axis_base.h"
#include "interpolated_motion_driver/axis/player.h"
#include "interpolated_motion_driver/axis/silverlode/command_sequence.h"
#include "interpolated_motion_driver/axis/silverlode/drive_commands.h"
#include "interpolated_motion_driver/axis/silverlode/look_pace.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/axis/silverlode/status.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::axis {

/// What the power stage of a SilverLode drive needs of its player besides.
class SegmentPlayer : public Player {
 public:
  /// Chooses the way segments take, at bring-up.
  virtual DriveCommands::Steps queue_steps() = 0;
  /// "queue of 8 segments", for the description of the axis.
  virtual std::string queue_text() const = 0;
  /// Takes the outcome if it belongs to a command of the player.
  virtual bool take(const silverlode::Outcome& outcome, HostTime now) = 0;
  /// The drive is in its interpolated motion, or about to be.
  virtual bool interpolates() const = 0;
};

/// A SilverLode drive on a serial line from the first question to the enabled driver, and back. It has no
/// heartbeat: it is asked for its status whenever the line has time for it.
class SilverlodePowerStage final : public AxisBase {
 public:
  /// `line` and `device` must outlive the power stage. Throws std::invalid_argument, naming joint and
  /// parameter.
  SilverlodePowerStage(SilverlodeAxisParameters parameters, silverlode::LineMaster& line,
                       silverlode::DeviceLink& device);
  /// In place of AxisBase::attach(), once, before anything else.
  void attach(SegmentPlayer& player);

  const std::string& bus() const override { return line_.line_name(); }
  std::string description() const override;
  void poll(HostTime now) override;
  HostTime next_deadline() const override;
  void enable(HostTime now) override;
  void disable(HostTime now) override;
  void reset_fault(HostTime now) override;
  const AxisFeedback& feedback() const override { return status_.feedback(); }
  void drive_status(AxisStatus& out) const override;

  // For the player.

  /// What the player works with; all of it lives as long as the power stage. Only one at a time uses
  /// `sequence`.
  const SilverlodeAxisParameters& parameters() const { return parameters_; }
  silverlode::LineMaster& line() const { return line_; }
  silverlode::DeviceLink& device() const { return device_; }
  const LookPace& pace() const { return pace_; }
  SilverlodeStatus& status() { return status_; }
  CommandSequence& sequence() { return sequence_; }
  DriveCommands& commands() { return commands_; }
  /// True when the commands are done; a failure is a fault.
  bool sequence_done(HostTime now);
  /// What may have happened to a drive that stands.
  void watch_rest(HostTime now);

 private:
  std::string device_name() const override { return device_.name(); }
  void listen(HostTime now) override;
  void go_on(HostDuration away, HostTime now) override;
  void poll_stage(HostTime now) override;
  void forget_drive() override;
  void probe(HostTime now) override;
  std::optional<bool> probe_answer() const override;
  std::string no_answer_text() const override;
  void configure(HostTime now) override;
  void drop_work() override;
  void press_stop(HostTime now) override;
  bool stands() const override { return sequence_.state() == CommandSequence::State::Done; }
  bool obeys_stop() const override { return sequence_.running() && heard_stop_; }
  std::string cause_text() const override;
  std::optional<bool> switch_off(HostTime now) override;
  std::string unseen_text() const override;

  void poll_configuring(HostTime now);
  void look_at_drive(HostTime now);
  HostDuration look_period() const;
  std::string state_text() const;

  const SilverlodeAxisParameters parameters_;
  silverlode::LineMaster& line_;
  silverlode::DeviceLink& device_;
  SegmentPlayer* player_ = nullptr;
  LookPace pace_;
  CommandSequence sequence_;
  SilverlodeStatus status_;
  DriveCommands commands_;
  SilverlodeFacts facts_;
  std::uint64_t second_replies_ = 0;  ///< of the link, when the bring-up began
  bool heard_stop_ = false;           ///< whether the drive has answered to STP since a fault was found
};

}  // namespace interpolated_motion::axis
