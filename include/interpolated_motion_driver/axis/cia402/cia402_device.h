#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/cia402/cia402_report.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/emcy.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What kinds of CiA 402 drives differ in as long as they do not move: how they are configured, what they
/// tell of themselves by their PDOs, and by what controlword they stop.
class Cia402Device {
 public:
  Cia402Device() = default;
  virtual ~Cia402Device() = default;
  Cia402Device(const Cia402Device&) = delete;
  Cia402Device& operator=(const Cia402Device&) = delete;

  /// What was found, without joint and node.
  virtual std::string description() const = 0;
  /// Identifies, verifies and configures the drive, of which nothing is known yet; to be run by `sequence`.
  virtual std::vector<SdoSequence::Step> bring_up_steps(SdoSequence& sequence) = 0;
  /// What depends on where the drive stands when it is about to be enabled.
  virtual std::vector<SdoSequence::Step> enable_steps() const = 0;
  /// What a drive in fault is to be told before its fault is reset; done without where it fails.
  virtual std::vector<SdoSequence::Step> reset_steps() const { return {}; }
  /// Everything that the axis needs to be told once has been told after `since`.
  virtual bool has_reported(HostTime since) const = 0;
  /// The drive is configured and reports.
  virtual void on_started() {}
  /// The drive shows the mode it has been put into (0x6061); its power stage is off.
  virtual void on_mode_selected() {}
  /// The power stage is about to be enabled; called again and again until it is. `commanded`: the controlword
  /// that does it has been sent.
  virtual void on_enabling(bool /*commanded*/) {}
  /// The controlword that makes an enabled drive brake, whatever it is doing, and rest.
  virtual std::uint16_t stop_word() const = 0;

  /// What the drive has told by its PDOs, one object for the device's life: the power stage keeps a
  /// reference, and sets `mode` when it has read 0x6061.
  virtual Cia402Report& report() = 0;
  virtual const Cia402Report& report() const = 0;
  /// The drive stands, or almost, at `position` (counts): read by SDO at `now`, since no PDO comes.
  virtual void take_position(std::int32_t position, HostTime now) = 0;
  /// Latest position and velocity, in joint units; one object for the device's life.
  virtual const AxisFeedback& feedback() const = 0;
  /// An EMCY message in words, by the drive's own list of codes, for Axis::fault_text().
  virtual std::string text_of(const canopen::Emcy& emcy) const = 0;
  /// What the drive tells of a fault besides its EMCY.
  virtual std::string fault_detail() const { return {}; }
  /// "its settings", for the sentence about a drive that has restarted.
  virtual std::string lost_by_restart() const = 0;
};

}  // namespace interpolated_motion::axis
