#pragma once

#include <cstdint>
#include <string_view>

namespace interpolated_motion::silverlode {

/// Why a drive refused a request: the code of a NAK.
enum class NakCode : std::uint16_t {
  BadCommand = 1,
  DeviceBusy = 2,  ///< a program or a motion runs
  Reserved3 = 3,
  Reserved4 = 4,
  BadFormat = 5,
  BufferFull = 6,  ///< IMW: every stage of the queue is taken
  BadAddress = 7,
  BadResponseRequest = 8,
  BadLockoutCode = 9,
  BadChecksum = 10,
};
inline constexpr std::uint16_t kMaxNakCode = 10;  ///< greatest value of NakCode

/// "buffer full"; "unknown code" for one that is none of the above.
std::string_view to_text(NakCode code);

}  // namespace interpolated_motion::silverlode
