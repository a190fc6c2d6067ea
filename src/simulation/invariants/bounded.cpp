#include "simulation/invariants/bounded.h"

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

constexpr std::size_t kLinesPerSecond = 200;  ///< 12 joints tell of themselves twice, and every order once
constexpr std::size_t kLongestText = 10000;   ///< characters: 12 joints with some sentences each

}  // namespace

void Bounded::look(const Look& look) {
  if (seconds(look.now - second_) > 1.0) {
    second_ = look.now;
    lines_ = 0;
  }
  lines_ += look.log_lines;
  if (lines_ > kLinesPerSecond) fail(fmt::format("{} lines of log within a second", lines_));
  if (look.snapshot->fault.size() > kLongestText)
    fail(fmt::format("a fault text of {} characters", look.snapshot->fault.size()));
}

}  // namespace interpolated_motion::simulation
