#include "interpolated_motion_driver/node/log_throttle.h"

#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::node {
namespace {

constexpr HostDuration kQuiet = std::chrono::seconds(1);

}  // namespace

std::optional<std::string> LogThrottle::pass(const std::string& text, HostTime now) {
  if (last_ && now - *last_ < kQuiet) {
    ++left_out_;
    return std::nullopt;
  }
  last_ = now;
  const std::uint64_t before = std::exchange(left_out_, 0);
  if (before == 0) return text;
  return fmt::format("{} (and {} like it before that were not logged)", text, before);
}

}  // namespace interpolated_motion::node
