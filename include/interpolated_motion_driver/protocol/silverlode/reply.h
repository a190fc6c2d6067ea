#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/protocol/silverlode/nak.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

enum class ReplyType : std::uint8_t {
  Ack,   ///< "* AA"
  Data,  ///< "# AA CCCC DDDD ..."
  Nak,   ///< "! AA CCCC EEEE"
};

/// A whole reply of a drive, all its numbers hexadecimal on the line.
struct Reply {
  ReplyType type = ReplyType::Ack;                    ///< decides which of the rest mean anything
  std::uint8_t address = 0;                           ///< of the drive that replies, 1..254
  std::uint16_t command = 0;                          ///< echo of the request's, Data and Nak only
  std::uint8_t word_count = 0;                        ///< of `words`, 0..kMaxReplyWords
  std::array<std::uint16_t, kMaxReplyWords> words{};  ///< Data only
  NakCode nak{};                                      ///< Nak only
  HostTime begin{};                                   ///< arrival of its first character, '*', '#' or '!'
  HostTime end{};                                     ///< arrival of its CR
};

}  // namespace interpolated_motion::silverlode
