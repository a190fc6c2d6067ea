#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/protocol/silverlode/line_text.h"
#include "interpolated_motion_driver/protocol/silverlode/nak.h"
#include "interpolated_motion_driver/protocol/silverlode/reply.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// Names a request of one device; larger ones were made later.
using RequestId = std::uint64_t;
/// No request: it was not taken.
inline constexpr RequestId kNoRequest = 0;

enum class OutcomeKind : std::uint8_t {
  Acknowledged,
  Data,
  Refused,  ///< NAK: the drive has not executed it
  NoReply,  ///< nothing came in time; the drive may have executed it
  Garbled,  ///< what came was no whole reply; the drive may have executed it
  Sent,     ///< RST: there is no reply
  Dropped,  ///< never sent, see `DeviceLink::drop_requests` and `LineMaster::clear_outgoing`
};

/// How a request ended. When `attempts` is above 1 the reply may be that of an earlier attempt, so its times
/// are of no use for a drive's clock.
struct Outcome {
  RequestId id = kNoRequest;                ///< as DeviceLink::request() or offer_bulk() has returned it
  Request request;                          ///< that it is about
  OutcomeKind kind = OutcomeKind::Dropped;  ///< decides which of the rest mean anything
  std::uint8_t word_count = 0;              ///< of `words`, 0..kMaxReplyWords
  std::array<std::uint16_t, kMaxReplyWords> words{};  ///< Data only
  NakCode nak{};                                      ///< Refused only
  int attempts = 0;                                   ///< times the request went on the line
  HostTime request_end{};  ///< last bit of the request on the line (of the last attempt), computed
  HostTime reply_begin{};  ///< first bit of the reply: `reply_end` less the reply's length
  HostTime reply_end{};    ///< last bit of the reply; without one, when it was given up
  /// Garbled: the line that came instead. NoReply: a line that came meanwhile and was not the answer, if any.
  LineText received;

  /// The drive has taken the request.
  bool accepted() const { return kind == OutcomeKind::Acknowledged || kind == OutcomeKind::Data; }
  /// It is not known whether the drive has executed the request.
  bool unknown() const { return kind == OutcomeKind::NoReply || kind == OutcomeKind::Garbled; }
  /// The drive has refused the request for this reason.
  bool refused_with(NakCode code) const { return kind == OutcomeKind::Refused && nak == code; }
  /// Data: word `n`; empty when the reply has not that many.
  std::optional<std::uint16_t> word(std::size_t n = 0) const;
  /// Data of RRG: the `n`-th register read; empty when the reply has not that many.
  std::optional<std::int32_t> register_value(std::size_t n = 0) const;
  /// Acknowledged or data of POL and POR: the polling status word, 0 for an ACK.
  std::optional<std::uint16_t> polling_status() const;
};

}  // namespace interpolated_motion::silverlode
