#pragma once

#include <string>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/axis_notes.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// A drive from the first question to the enabled power stage, and back: found, identified, configured,
/// enabled, disabled, watched, its faults told and reset. What it does while it is enabled is its Player's.
/// The functions are those of Axis.
class PowerStage {
 public:
  PowerStage() = default;
  virtual ~PowerStage() = default;
  PowerStage(const PowerStage&) = delete;
  PowerStage& operator=(const PowerStage&) = delete;

  /// As Axis. None of them changes, but for description(), which knows more after each bring-up.
  virtual const std::string& joint() const = 0;
  virtual const std::string& bus() const = 0;
  virtual std::string description() const = 0;
  /// As Axis; while the drive is enabled, the state that its player tells.
  virtual AxisState state() const = 0;
  virtual const std::string& fault_text() const = 0;

  /// As Axis; lets the player play while the drive is enabled.
  virtual void poll(HostTime now) = 0;
  virtual HostTime next_deadline() const = 0;

  /// As Axis. What does not suit the state is passed over without a word: enable() but in Disabled, disable()
  /// but in Ready, reset_fault() but in Fault and Offline.
  virtual void bring_up(HostTime now) = 0;
  virtual void enable(HostTime now) = 0;
  virtual void disable(HostTime now) = 0;
  virtual void reset_fault(HostTime now) = 0;

  /// As Axis, in joint units; kept when the drive falls silent, so look at its time.
  virtual const AxisFeedback& feedback() const = 0;
  /// Sets `online`, `state`, `statusword`, `mode`, `error_code` and `error_text`.
  virtual void drive_status(AxisStatus& out) const = 0;

  /// What is to be logged of the drive.
  AxisNotes& notes() { return notes_; }

 private:
  AxisNotes notes_;
};

}  // namespace interpolated_motion::axis
