#pragma once

#include <optional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/player.h"
#include "interpolated_motion_driver/axis/power_stage.h"
#include "interpolated_motion_driver/axis/stage_time.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What every power stage has to do whatever its drive: look for a drive that does not answer yet, keep the
/// time of its stages, notice that its drive has fallen silent, let its player play while the drive is
/// enabled, and bring a fault to an end, which is not before the drive stands.
class AxisBase : public PowerStage {
 public:
  const std::string& joint() const override { return settings_.joint; }
  AxisState state() const override;
  const std::string& fault_text() const override { return fault_text_; }

  void poll(HostTime now) override;
  HostTime next_deadline() const override;
  void bring_up(HostTime now) override;
  void disable(HostTime now) override;

  /// Who plays while the drive is enabled. To be called once, before anything else.
  void attach(Player& player) { player_ = &player; }

  // For the player.

  /// The drive is enabled and its player plays; false as soon as a fault is found or disabling begins.
  bool enabled() const { return stage_ == Stage::Enabled; }
  /// Of the stage, or of the phase within it that the player has begun.
  StageTime& time() { return time_; }
  /// The axis is in fault; in motion not before its drive stands. The first reason is the one that is told.
  void fail(const std::string& reason, HostTime now);
  /// The drive is gone and does not move: it was off or restarted, or was never there.
  void go_offline(const std::string& reason, HostTime now);
  /// "Joint joint1 (can0 node 1)".
  std::string who() const;

 protected:
  struct Settings {
    std::string joint;                ///< for joint() and messages
    HostDuration bring_up_timeout{};  ///< longest wait for the drive's first answer
  };

  enum class Stage {
    Offline,
    Probing,  ///< waits for the first answer
    Configuring,
    Disabled,
    Enabling,
    Enabled,
    Disabling,
    Resetting,
    FaultStopping,  ///< a fault was found in motion; told to stop until it stands or cannot move any more
    SwitchingOff,   ///< in fault or lost, and told to switch its power stage off
    Fault,
  };

  /// How often an axis wants to be polled while it works towards something.
  static constexpr HostDuration kPollInterval = std::chrono::milliseconds(5);
  /// The same in motion, where what the drive tells is an event of its own and what it has to play lasts far
  /// longer.
  static constexpr HostDuration kMotionPollInterval = std::chrono::milliseconds(10);

  explicit AxisBase(Settings settings) : settings_(std::move(settings)) {}

  // What kinds of drives differ in.

  /// "can0 node 1", for texts.
  virtual std::string device_name() const = 0;
  /// Takes what the drive has told.
  virtual void listen(HostTime now) = 0;
  /// Goes on with what has been begun; the host was `away` since it did so last.
  virtual void go_on(HostDuration away, HostTime now) = 0;
  /// Of the stages from Configuring to Resetting, but for Enabled.
  virtual void poll_stage(HostTime now) = 0;

  /// Nothing is known of the drive any more.
  virtual void forget_drive() = 0;
  /// Asks the drive for a sign of life.
  virtual void probe(HostTime now) = 0;
  /// Whether the drive has given it; empty while that is open.
  virtual std::optional<bool> probe_answer() const = 0;
  /// Ends the sentence "no drive answers within 5 s", with what to do.
  virtual std::string no_answer_text() const = 0;
  /// The drive has answered: begins to identify, verify and configure it.
  virtual void configure(HostTime now) = 0;

  /// Of an enabled drive: its power stage may be on, for all that it has told.
  virtual bool is_powered() const { return true; }
  /// Gives up what has been begun.
  virtual void drop_work() = 0;
  /// Tells the drive to stop; called again and again until it stands, and sends what is due.
  virtual void press_stop(HostTime now) = 0;
  /// The drive has shown, since it was told to stop, that it stands.
  virtual bool stands() const = 0;
  /// The drive has answered to the stop: whether it stands will show, however long that takes.
  virtual bool obeys_stop() const { return false; }
  /// What a drive that has come to rest has told of the fault since: a sentence with a blank before it, or
  /// nothing.
  virtual std::string cause_text() const { return {}; }
  /// Switches off the power stage of a drive that is in fault or lost: begins to when nothing has been begun,
  /// and tells how it has ended, nothing while that is open.
  virtual std::optional<bool> switch_off(HostTime now) = 0;
  /// Why it is not known whether the drive stands.
  virtual std::string unseen_text() const = 0;

  // For derived classes.

  Stage stage() const { return stage_; }
  /// The drive has answered and has not been lost since; one that is told to stop or to switch off after it
  /// has been lost is not there: it may have restarted, and what is known of it is old.
  bool is_online() const;
  void enter(Stage stage, HostTime now);
  const StageTime& time() const { return time_; }
  /// As fail(), which ends in Stage::Fault; of a drive that is not heard any more in Stage::Offline.
  void end_in(Stage stage, const std::string& reason, HostTime now);

 private:
  void run_stage(HostTime now);
  void poll_probing(HostTime now);
  void poll_fault_stopping(HostTime now);
  void poll_switching_off(HostTime now);

  const Settings settings_;
  Player* player_ = nullptr;
  StageTime time_;
  HostTime reported_{};  ///< the last position that has come
  Stage stage_ = Stage::Offline;
  Stage after_stop_ = Stage::Fault;  ///< Fault or Offline
  HostTime rest_due_{};              ///< of a drive that hears nothing more since a fault was found
  std::string fault_text_;
};

}  // namespace interpolated_motion::axis
