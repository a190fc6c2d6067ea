#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/axis/axis_notes.h"
#include "interpolated_motion_driver/axis/cia402/cia402_device.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/emcy.h"
#include "interpolated_motion_driver/protocol/canopen/node_link.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The error of a drive from its begin to its end (CiA 301, 7.2.7): an EMCY message tells when one comes, one
/// with code 0x0000 when it is over or has been reset. Where no message has been heard, 0x1001 and 0x1003
/// tell it. Each begin and end is noted for the log, once.
class DriveErrors {
 public:
  /// `who`: how joint and drive are called in texts. All must outlive the object.
  DriveErrors(const Cia402Device& device, SdoSequence& sequence, AxisNotes& notes,
              std::function<std::string()> who)
      : device_(device), sequence_(sequence), notes_(notes), who_(std::move(who)) {}

  /// Takes the messages that have come.
  void collect(canopen::NodeLink& node, HostTime now);
  void take(const canopen::Emcy& emcy, HostTime now);
  /// The drive has none any more.
  void end(HostTime now);
  /// For the sequence: reads what the drive has, which may be an error that no message has told, or the end
  /// of one. A drive that does not answer is no failure.
  SdoSequence::Step read(HostTime now);
  /// Notes something else about the drive.
  void note(bool is_problem, const std::string& text, HostTime now);

  /// Of the error that came last and is not over; 0: none.
  std::uint16_t code() const { return code_; }
  /// "EMCY 0x8611 following error (error register 0x21: ...)"; empty without an error.
  const std::string& text() const { return text_; }
  /// The same after the error that came first and may be the cause of it: "EMCY ..., then EMCY ...".
  std::string history() const { return first_ == text_ ? text_ : first_ + ", then " + text_; }

 private:
  void set(const canopen::Emcy& emcy);
  void take_read(std::uint8_t error_register, std::uint32_t newest, HostTime now);
  SdoSequence::Step read_newest(std::uint8_t error_register, HostTime now);

  const Cia402Device& device_;
  SdoSequence& sequence_;
  AxisNotes& notes_;
  std::function<std::string()> who_;
  std::uint16_t code_ = 0;
  std::string text_;
  std::string first_;  ///< text of the one since which there has always been one
};

}  // namespace interpolated_motion::axis
