#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/cia402/cia402_device.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The second way to stop a drive and to see it at rest: by SDO, which a drive takes that takes no PDOs, in
/// Pre-operational or with another mapping (CiA 301, 7.3.2.2). The statusword is read before anything is
/// written, since the controlword that halts a drive may switch on one that is off.
class SdoStop {
 public:
  /// Both must outlive the object, which has `sequence` for itself while it is polled.
  SdoStop(SdoSequence& sequence, Cia402Device& device) : sequence_(sequence), device_(device) {}

  /// Another stop begins, or the drive may have forgotten the last.
  void begin();
  /// Reads statusword and position into the device's report, and writes `word` while the drive is enabled;
  /// again and again.
  void poll(std::uint16_t word, HostTime now);
  /// The drive has taken the word, and has told since then that it stands.
  bool halted() const;

 private:
  void take_round(HostTime now);

  SdoSequence& sequence_;
  Cia402Device& device_;
  bool running_ = false;          ///< a round of reading and writing has been begun
  bool written_ = false;          ///< the word has been taken
  bool round_after_ = false;      ///< what the round under way reads comes after that
  bool read_after_ = false;       ///< what the last round has read has come after that
  std::uint16_t statusword_ = 0;  ///< of the last round
  std::int32_t position_ = 0;     ///< counts, of the last round
};

}  // namespace interpolated_motion::axis
