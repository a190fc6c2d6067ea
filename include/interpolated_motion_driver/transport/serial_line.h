#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// A character received, and the time of its last bit.
struct ReceivedCharacter {
  char value = 0;   ///< the 8 data bits
  HostTime time{};  ///< as well as the line can tell it
};

/// One serial line as the host sees it. Never blocks.
class SerialLine {
 public:
  virtual ~SerialLine() = default;

  /// Puts all of `text` into the transmit buffer. Returns false, and takes nothing, when it does not fit or
  /// the line is down: the caller keeps the text and tries again later.
  virtual bool send(std::string_view text, HostTime now) = 0;

  /// The next character received, oldest first. Empty when there is none.
  virtual std::optional<ReceivedCharacter> receive() = 0;
};

}  // namespace interpolated_motion::transport
