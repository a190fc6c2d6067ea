#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "interpolated_motion_driver/protocol/silverlode/command.h"
#include "interpolated_motion_driver/protocol/silverlode/line_text.h"

namespace interpolated_motion::silverlode {

/// Every drive obeys a request to this address, none answers it.
inline constexpr std::uint8_t kGlobalAddress = 255;
/// Addresses of single drives are 1..254; drives leave the factory with 16.
inline constexpr std::uint8_t kMaxAddress = 254;
/// Most words in a data reply that are kept: four registers.
inline constexpr std::size_t kMaxReplyWords = 8;

/// What a drive answers when it accepts a request. It answers any request with a NAK when it does not.
enum class ReplyKind : std::uint8_t {
  Ack,
  Data,
  AckOrData,  ///< POL: ACK when the status word is 0
  None,       ///< RST, and every request to the global address
};

/// A request as it goes on the line in 8-bit ASCII: "@16 12 1" and CR, all numbers decimal.
struct Request {
  std::uint8_t address = 0;          ///< 1..254, or kGlobalAddress
  Command command = Command::POL;    ///< echoed by data replies and NAKs
  ReplyKind reply = ReplyKind::Ack;  ///< when the drive accepts it
  std::uint8_t reply_words = 0;      ///< of a data reply; 0: any number
  bool repeatable = true;            ///< false: executing it twice is not the same as once (IMW, IMS)
  bool patient = false;  ///< a reply that is late is waited for, see LineMaster: not while anything moves
  LineText text;         ///< with the CR
};

/// Longest reply to a request the drive accepts, in characters with the CR: ACK 5, data 10 + 5 per word, 0
/// when there is none. Eight words where their number is not known.
std::size_t reply_characters(const Request& request);
/// The same with a NAK (15 characters) among the replies: what a time-out must leave time for.
std::size_t longest_reply_characters(const Request& request);

/// The request of `command` with `count` decimal arguments. The functions below are the ones to use.
Request make_request(std::uint8_t address, Command command, const std::int32_t* arguments, std::size_t count);

/// Poll: the polling status word, see `PollingStatus`, or an ACK when it is 0.
Request pol_request(std::uint8_t address);
/// Poll with a data reply of one word, whatever it is (SilverDust revision 05 and later).
Request por_request(std::uint8_t address);
/// Clears the bits of `mask` in the polling status word. A drive clears only bits that it has reported
/// before.
Request cpl_request(std::uint8_t address, std::uint16_t mask);
/// Hard stop of motion and program; the motor driver is then disabled.
Request hlt_request(std::uint8_t address);
/// `deceleration`: -1 at once, 0 that of the running command, 1..2^29 in units of acceleration (4000 RPM per
/// tick = 2^31).
Request stp_request(std::uint8_t address, std::int32_t deceleration);
/// Restarts the drive, which answers nothing.
Request rst_request(std::uint8_t address);
/// Reads the revision of the firmware.
Request rvn_request(std::uint8_t address);
/// Writes a 32-bit register at once, during a motion too.
Request wri_request(std::uint8_t address, std::uint16_t register_number, std::int32_t value);
/// Reads 1 to 4 registers: two words of the reply each, high word first. More than one at a time only on
/// SilverDust revision 31 and later.
template <class... Registers>
Request rrg_request(std::uint8_t address, Registers... registers);
/// Reads the internal status word, see `InternalStatus`.
Request ris_request(std::uint8_t address);
/// Reads the I/O status word, see `IoStatus`.
Request rio_request(std::uint8_t address);
/// One segment for the queue of the interpolated motion, the numbers as in QCI-TD044: `time` in servo ticks
/// (0 ends the motion), `position` in counts, `acceleration` and `velocity` in the units of IMS. A full queue
/// is NAK 6. Not repeatable: a lost ACK does not tell whether the segment is in the queue.
Request imw_request(std::uint8_t address, std::int32_t time, std::int32_t position, std::int32_t acceleration,
                    std::int32_t velocity);
/// Moves to `position` (counts); `acceleration` and `velocity` in the units of ordinary commands. Without a
/// stop condition.
Request mav_request(std::uint8_t address, std::int32_t position, std::int32_t acceleration,
                    std::int32_t velocity);
/// Makes the actual position the target: the position error is 0 then.
Request ttp_request(std::uint8_t address);
/// Calls the present place 0: target and position.
Request ztp_request(std::uint8_t address);
/// `moving` and `holding` in counts, `delay` in servo ticks.
Request erl_request(std::uint8_t address, std::int16_t moving, std::int16_t holding, std::uint16_t delay);
/// Clears the latched bits of the internal status word.
Request cis_request(std::uint8_t address);
/// Bits of the internal status word that stop the motor (`enable`), in which state each.
Request kmc_request(std::uint8_t address, std::uint16_t enable, std::uint16_t state);
/// `delay` of replies in servo ticks: `LineParameters::reply_timeout` must be longer.
Request adl_request(std::uint8_t address, std::uint16_t delay);
/// Switches the motor driver on, and off.
Request emd_request(std::uint8_t address);
Request dmd_request(std::uint8_t address);
/// Starts the interpolated motion. Which parameters IMS takes is in no document at hand; its sister commands
/// take stop enable and stop state, hence "0 0". `arguments`: up to four decimal numbers, one space between
/// two; empty for none. Throws std::invalid_argument otherwise. Not repeatable.
Request ims_request(std::uint8_t address, std::string_view arguments = "0 0");
/// Empties the queue of IMW.
Request imq_request(std::uint8_t address);

template <class... Registers>
Request rrg_request(std::uint8_t address, Registers... registers) {
  constexpr std::size_t kCount = sizeof...(registers);
  static_assert(kCount >= 1 && kCount <= 4, "RRG reads 1 to 4 registers");
  const std::array<std::int32_t, kCount> arguments{static_cast<std::int32_t>(registers)...};
  return make_request(address, Command::RRG, arguments.data(), kCount);
}

}  // namespace interpolated_motion::silverlode
