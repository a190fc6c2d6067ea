#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// Keeps a log readable, and a disk from filling, when somebody sends one bad message after the other: one
/// line a second, which tells how many there were since the last one.
class LogThrottle {
 public:
  /// `text` as it is to be logged at `now`; nothing while the line before is less than a second old.
  std::optional<std::string> pass(const std::string& text, HostTime now);

 private:
  std::optional<HostTime> last_;
  std::uint64_t left_out_ = 0;
};

}  // namespace interpolated_motion::node
