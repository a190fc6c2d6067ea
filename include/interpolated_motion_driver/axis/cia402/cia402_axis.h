#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis_base.h"
#include "interpolated_motion_driver/axis/cia402/cia402_report.h"
#include "interpolated_motion_driver/axis/cia402/controlword_link.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

/// A CiA 402 drive on CANopen from the first question to the enabled power stage, and back: found,
/// configured, started (NMT), put into its mode, enabled, watched, its faults told and reset. What it does
/// while it is enabled is the derived class's: its phases, between which begin_phase() gives each its time.
class Cia402Axis : public AxisBase {
 public:
  const std::string& bus() const override { return master_.bus_name(); }

  void enable(HostTime now) override;
  void disable(HostTime now) override;
  void reset_fault(HostTime now) override;

 protected:
  struct Settings {
    std::string joint;
    cia402::Mode mode;
    int controlword_rpdo;
    HostDuration heartbeat_timeout;
    HostDuration bring_up_timeout;
  };

  /// Longest a drive may take for one change of state.
  static constexpr HostDuration kStateTimeout = std::chrono::seconds(2);

  /// `master` and `node` must outlive the axis.
  Cia402Axis(const Settings& settings, canopen::Master& master, canopen::NodeLink& node);

  // ---- what kinds of drives differ in

  /// Identifies, verifies and configures the drive, of which nothing is known yet.
  virtual std::vector<SdoSequence::Step> bring_up_steps() = 0;
  /// Everything that the axis needs to be told once has been told after `since`.
  virtual bool has_reported(HostTime since) const = 0;
  /// The drive is configured and reports.
  virtual void on_started() {}
  virtual void on_mode_selected() {}
  /// The power stage is about to be enabled; called again and again until it is.
  virtual void on_enabling() {}
  /// The power stage is enabled: the first phase begins.
  virtual void on_enabled(HostTime now) = 0;
  virtual void poll_enabled(HostTime now) = 0;
  /// The phase of the enabled drive is one in which it moves.
  virtual bool is_motion_phase() const = 0;
  /// A drive that is still enabled has shown that it obeys the stop and stands.
  virtual bool halted() const { return false; }

  virtual Cia402Report& drive() = 0;
  virtual const Cia402Report& drive() const = 0;
  virtual std::string text_of(const canopen::Emcy& emcy) const = 0;
  /// What the drive tells of a fault besides its EMCY.
  virtual std::string fault_detail() const { return {}; }
  /// "its settings", for the sentence about a drive that has restarted.
  virtual std::string lost_by_restart() const = 0;

  void give_up(HostTime now) override;

  // ---- for derived classes

  bool enabling() const { return stage() == Stage::Enabling && by_pdo_; }
  /// On the way to the power stage being off.
  bool disabling() const { return stage() == Stage::Disabling; }
  bool obeys() const { return drive().statusword.state() == cia402::State::OperationEnabled; }

  /// True when the steps are done; a failure is a fault.
  bool sequence_done(HostTime now);
  /// What the base knows of the drive.
  void fill_status(AxisStatus& out) const;

  canopen::Master& master() const { return master_; }
  canopen::NodeLink& node() const { return node_; }
  SdoSequence& sequence() { return sequence_; }
  ControlwordLink& controlword() { return controlword_; }
  const ControlwordLink& controlword() const { return controlword_; }

 private:
  std::string device_name() const override { return node_.name(); }
  void listen(HostTime now) override;
  void go_on(HostDuration away, HostTime now) override;
  void poll_stage(HostTime now) override;
  void forget_drive() override { configured_ = false; }
  void probe(HostTime now) override;
  std::optional<bool> probe_answer() const override;
  std::string no_answer_text() const override;
  void configure(HostTime now) override;
  bool may_move() const override;
  bool stands() const override;
  std::string unseen_text() const override;

  void collect_emergencies();
  void watch_heartbeat(HostTime now);
  void watch_power_stage(HostTime now);
  void poll_configuring(HostTime now);
  void poll_reports(HostTime now);
  void poll_selecting_mode(HostTime now);
  void poll_enabling(HostTime now);
  void poll_disabling(HostTime now);
  void poll_resetting(HostTime now);

  SdoSequence::Step read_mode();
  bool walk_to(cia402::State target, HostTime now);
  std::string drive_fault() const;

  const Settings settings_;
  canopen::Master& master_;
  canopen::NodeLink& node_;
  SdoSequence sequence_;
  ControlwordLink controlword_;

  /// The stage has come from SDO to PDO: Configuring to the first reports, Enabling from the mode to the
  /// controlword.
  bool by_pdo_ = false;
  bool configured_ = false;
  bool silent_ = false;  ///< no heartbeat comes
  std::uint16_t error_code_ = 0;
  std::string error_text_;
};

}  // namespace interpolated_motion::axis
