#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/cia402/cia402_report.h"
#include "interpolated_motion_driver/axis/cia402/controlword_link.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

/// A CiA 402 drive on CANopen from the first question to the enabled power stage, and back: found,
/// configured, started (NMT), put into its mode, enabled, watched, its faults told and reset. What it does
/// while it is enabled is the derived class's: its phases, between which begin_phase() gives each its time.
class Cia402Axis : public Axis {
 public:
  const std::string& joint() const override { return settings_.joint; }
  const std::string& bus() const override { return master_.bus_name(); }
  AxisState state() const override;
  const std::string& fault_text() const override { return fault_text_; }

  void poll(HostTime now) override;
  HostTime next_deadline() const override;

  void bring_up(HostTime now) override;
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
  Cia402Axis(Settings settings, canopen::Master& master, canopen::NodeLink& node);

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
  /// Of the phase the enabled drive is in.
  virtual AxisState enabled_state() const = 0;
  /// The axis is about to be in fault: nothing more is sent that would move the drive.
  virtual void give_up(HostTime now) = 0;

  virtual Cia402Report& drive() = 0;
  virtual const Cia402Report& drive() const = 0;
  virtual std::string text_of(const canopen::Emcy& emcy) const = 0;
  /// What the drive tells of a fault besides its EMCY.
  virtual std::string fault_detail() const { return {}; }
  /// "its settings", for the sentence about a drive that has restarted.
  virtual std::string lost_by_restart() const = 0;

  // ---- for derived classes

  bool enabled() const { return stage_ == Stage::Enabled; }
  bool enabling() const { return stage_ == Stage::Enabling; }
  /// On the way to the power stage being off, from a drive whose PDOs are configured.
  bool disabling() const { return stage_ == Stage::Disabling && configured_; }

  void begin_phase(HostTime now);
  HostTime since() const { return since_; }
  /// `limit` is over since the stage or phase began. It is for the drive: what the host was away for does not
  /// count.
  bool expired(HostTime now, HostDuration limit) const { return now - since_ - away_ > limit; }
  /// A position has come from the drive.
  void note_report() { absent_at_report_ = absent_; }
  /// How long no position has come, the last one of `last`, as far as the host was there to hear it.
  HostDuration silence(HostTime now, HostTime last) const {
    return now - last - (absent_ - absent_at_report_);
  }
  /// True when the steps are done; a failure is a fault.
  bool sequence_done(HostTime now);
  void fail(const std::string& reason, HostTime now);
  std::string who() const;
  /// What the base knows of the drive.
  void fill_status(AxisStatus& out) const;

  canopen::Master& master() const { return master_; }
  canopen::NodeLink& node() const { return node_; }
  SdoSequence& sequence() { return sequence_; }
  ControlwordLink& controlword() { return controlword_; }

 private:
  enum class Stage {
    Offline,
    Probing,  ///< waits for the first answer
    Configuring,
    StartingNode,  ///< waits for the first reports
    Disabled,
    SelectingMode,
    Enabling,
    Enabled,
    Disabling,
    Resetting,
    Fault,
  };

  void note_stall(HostTime now);
  void collect_emergencies();
  void watch_heartbeat(HostTime now);
  void watch_power_stage(HostTime now);
  void run_stage(HostTime now);
  void probe(HostTime now);
  void poll_probing(HostTime now);
  void poll_configuring(HostTime now);
  void poll_starting_node(HostTime now);
  void poll_selecting_mode(HostTime now);
  void poll_enabling(HostTime now);
  void poll_disabling(HostTime now);
  void poll_resetting(HostTime now);

  SdoSequence::Step read_mode();
  bool walk_to(cia402::State target, HostTime now);
  void enter(Stage stage, HostTime now);
  void go_offline(const std::string& reason, HostTime now);
  std::string drive_fault() const;

  const Settings settings_;
  canopen::Master& master_;
  canopen::NodeLink& node_;
  SdoSequence sequence_;
  ControlwordLink controlword_;

  Stage stage_ = Stage::Offline;
  HostTime since_{};     ///< begin of the stage, or of the phase of an enabled drive
  HostDuration away_{};  ///< of the host, since then
  HostTime polled_{};
  HostDuration absent_{};            ///< of the host, in all
  HostDuration absent_at_report_{};  ///< the same when the last position came
  HostTime bring_up_since_{};
  bool configured_ = false;
  std::string fault_text_;
  std::uint16_t error_code_ = 0;
  std::string error_text_;
};

}  // namespace interpolated_motion::axis
