#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/axis_base.h"
#include "interpolated_motion_driver/axis/cia402/cia402_device.h"
#include "interpolated_motion_driver/axis/cia402/controlword_link.h"
#include "interpolated_motion_driver/axis/cia402/drive_errors.h"
#include "interpolated_motion_driver/axis/cia402/node_watch.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/cia402/sdo_stop.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

/// What a CiA 402 power stage is to be told about its drive.
struct Cia402Settings {
  std::string joint;               ///< for joint() and messages
  cia402::Mode mode;               ///< written to 0x6060 before each enabling, and awaited in 0x6061
  int controlword_rpdo;            ///< 1..4: the synchronous RPDO that carries 0x6040
  HostDuration heartbeat_timeout;  ///< for messages; the watch itself is the bus master's
  HostDuration bring_up_timeout;   ///< longest wait for the drive's first answer
  HostDuration feedback_timeout;   ///< longest silence of its PDOs
};

/// A CiA 402 drive on CANopen from the first question to the enabled power stage, and back: found,
/// configured, started (NMT), put into its mode, enabled, watched, its faults told and reset.
class Cia402PowerStage final : public AxisBase {
 public:
  /// Longest a drive may take for one change of state.
  static constexpr HostDuration kStateTimeout = std::chrono::seconds(2);

  /// `device`, `master` and `node` must outlive the power stage.
  Cia402PowerStage(const Cia402Settings& settings, Cia402Device& device, canopen::Master& master,
                   canopen::NodeLink& node);

  const std::string& bus() const override { return master_.bus_name(); }
  std::string description() const override { return who() + ": " + device_.description(); }
  void enable(HostTime now) override;
  void disable(HostTime now) override;
  void reset_fault(HostTime now) override;
  const AxisFeedback& feedback() const override { return feedback_; }
  void drive_status(AxisStatus& out) const override;

  // For the player.

  /// The power stage is on, or about to be, and the drive takes what it is to follow.
  bool wants_targets() const;
  /// The drive has taken its controlword, which has the halt bit, and has told since that it stands.
  bool halted() const;
  /// True when the steps are done; a failure is a fault.
  bool sequence_done(HostTime now);
  SdoSequence& sequence() { return sequence_; }
  ControlwordLink& controlword() { return controlword_; }

 private:
  std::string device_name() const override { return node_.name(); }
  void listen(HostTime now) override;
  void go_on(HostDuration away, HostTime now) override;
  void poll_stage(HostTime now) override;
  void forget_drive() override;
  void probe(HostTime now) override;
  std::optional<bool> probe_answer() const override;
  std::string no_answer_text() const override;
  void configure(HostTime now) override;
  bool is_powered() const override;
  void drop_work() override;
  void press_stop(HostTime now) override;
  bool stands() const override;
  std::optional<bool> switch_off(HostTime now) override;
  std::string unseen_text() const override;

  void watch_node(HostTime now);
  void take(NodeEvent event, HostTime now);
  void watch_reports(HostTime now);
  void ask(HostTime now);
  void watch_power_stage(HostTime now);
  void poll_configuring(HostTime now);
  void poll_reports(HostTime now);
  void poll_selecting_mode(HostTime now);
  void poll_enabling(HostTime now);
  void poll_resetting(HostTime now);

  bool walk_to(cia402::State target, HostTime now);
  std::string drive_fault() const;

  const Cia402Settings settings_;
  Cia402Device& device_;
  Cia402Report& report_;          ///< of the device
  const AxisFeedback& feedback_;  ///< of the device
  canopen::Master& master_;
  canopen::NodeLink& node_;
  SdoSequence sequence_;
  ControlwordLink controlword_;

  /// The stage has come from SDO to PDO: Configuring to the first reports, Enabling from the mode to the
  /// controlword.
  bool by_pdo_ = false;
  bool configured_ = false;  ///< as bring-up has left it, for all that is known
  bool listening_ = false;   ///< the bus is listened to before the drive is asked
  bool asked_ = false;       ///< anything has ever been sent to the drive
  NodeWatch watch_;
  SdoStop sdo_stop_;
  DriveErrors errors_;
};

}  // namespace interpolated_motion::axis
