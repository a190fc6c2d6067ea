#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The controlword (0x6040) of a drive, sent on change by a synchronous RPDO: the drive obeys at the next
/// SYNC. The frame, or the SYNC behind it, can get lost: what has had no effect for a while is sent again.
class ControlwordLink {
 public:
  /// `rpdo` 1..4; `master` and `node` must outlive the link.
  ControlwordLink(canopen::Master& master, canopen::NodeLink& node, int rpdo)
      : master_(master), node_(node), rpdo_(rpdo) {}

  /// Queues `word` for the bus. Where the bus's queue is full nothing is queued, and word() and sent_at()
  /// stay.
  void send(std::uint16_t word, HostTime now);
  std::uint16_t word() const { return word_; }   ///< sent last
  HostTime sent_at() const { return sent_at_; }  ///< queued last; the epoch: never

  /// The last controlword and a SYNC behind it have been on the bus.
  bool applied() const;
  /// The last controlword has had its time: if there is no effect, it is to be sent again.
  bool overdue(HostTime now) const { return now - sent_at_ >= kRepeat; }

  /// What walk() has come to. NeedsFaultReset: the drive is in Fault, out of which only reset() leads. A
  /// target that cannot be commanded stays UnderWay, until the caller's patience ends.
  enum class Progress { Arrived, UnderWay, NeedsFaultReset };

  /// Sends what leads from `current` to `target`, one step at a call; `since`: when that walk began.
  Progress walk(cia402::State current, cia402::State target, HostTime since, HostTime now);

  /// Resets a fault, from `since` on; `current` has been told by the drive at `status_time`. The reset acts
  /// on the rising edge of bit 7, so 0x0000 goes before it; a drive that is in no fault is switched off by
  /// the same 0x0000. True once the drive is in Switch on disabled.
  bool reset(cia402::State current, HostTime status_time, HostTime since, HostTime now);

 private:
  static constexpr HostDuration kRepeat = std::chrono::milliseconds(100);

  canopen::Master& master_;
  canopen::NodeLink& node_;
  int rpdo_;
  std::uint16_t word_ = 0;
  HostTime sent_at_{};
  std::uint64_t due_ = 0;  ///< confirmations of the RPDO after which the last word is on the bus
};

}  // namespace interpolated_motion::axis
