#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// The drive's place on its serial line: which packets are for it, and how and when it answers ("Serial
/// Communications", QCI-TD053; Command Reference, IDT and ADL).
class SerialInterface {
 public:
  /// Where and when the answer to a packet goes, in the settings the packet was heard in.
  struct Reply {
    bool expected = false;      ///< false: packets to the group and to everybody are not answered
    int address = 0;            ///< the drive's own
    std::uint16_t command = 0;  ///< number that was heard: a Nak repeats it
    HostTime time{};            ///< of the first bit
  };

  /// A port of `line`, which must outlive it, for `listener`. `parameters` must outlive it, too.
  SerialInterface(transport::VirtualSerialLine& line, transport::SerialListener& listener,
                  const SilverDustParameters& parameters);

  /// As after power-up: identity, group and delay of the parameters; what was being heard or said is lost.
  void restart(HostTime now);

  /// While silent it neither hears (its owner asks silent()) nor says anything; what was being said is lost.
  void silence(bool silent, HostTime now);
  bool silent() const { return silent_; }

  /// The packet that this character has completed. One that is cut short is reported to `status`.
  std::optional<Packet> on_character(char value, PollingStatus& status) {
    if (parser_.cuts_short(value)) status.raise(polling_bit::kAborted);
    return parser_.on_character(value);
  }

  /// Whether the drive obeys a packet: one to itself, to its group or to everybody (255).
  bool obeys(const Packet& packet) const;

  /// How to answer `packet`, which was heard at `time`.
  Reply reply_to(const Packet& packet, HostTime time) const;

  /// Says `answer`, which is an Acknowledge, Data or a Nak; nothing when no reply is expected.
  void send(const Answer& answer, const Reply& reply);

  /// IDT: 1..254.
  void set_address(int address) { address_ = address; }

  /// IDT: 1..254; 0: none.
  void set_group(int group) { group_ = group; }

  /// ADL: ticks (120 us) that an answer waits, 0..65535.
  void set_ack_delay(int ticks) { ack_delay_ = ticks; }

  /// Naks said so far.
  std::uint64_t naks() const { return naks_; }

 private:
  void drop_answers(HostTime now);

  const SilverDustParameters& parameters_;
  transport::VirtualSerialLine& line_;
  const int port_;
  PacketParser parser_;
  int address_;
  int group_;
  int ack_delay_;
  bool silent_ = false;
  std::string text_;
  std::uint64_t naks_ = 0;
};

}  // namespace interpolated_motion::emulation
