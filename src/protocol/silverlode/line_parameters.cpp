#include "interpolated_motion_driver/protocol/silverlode/line_parameters.h"

#include <fmt/format.h>

#include <stdexcept>

namespace interpolated_motion::silverlode {
namespace {

template <class Value>
void check_range(const std::string& line, const char* parameter, Value value, Value low, Value high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(fmt::format("{}: {} = {} is not in {}..{}", line, parameter, value, low, high));
}

void check_duration(const std::string& line, const char* parameter, HostDuration value, HostDuration low,
                    HostDuration high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(fmt::format("{}: {} = {} s is not in {}..{} s", line, parameter, seconds(value),
                                          seconds(low), seconds(high)));
}

}  // namespace

void check(const std::string& line_name, const LineParameters& p) {
  using std::chrono::seconds;
  check_range<std::uint32_t>(line_name, "baud", p.baud, 300, 250'000);
  check_range(line_name, "bits_per_character", p.bits_per_character, 10, 12);
  check_duration(line_name, "turnaround", p.turnaround, seconds(0), seconds(1));
  check_duration(line_name, "reply_timeout", p.reply_timeout, p.turnaround, seconds(10));
  check_duration(line_name, "guard", p.guard, seconds(0), seconds(10));
  check_duration(line_name, "pause", p.pause, seconds(0), seconds(1));
  check_range(line_name, "repeats", p.repeats, 0, 100);
  check_range<std::size_t>(line_name, "request_capacity", p.request_capacity, 2, 4096);
}

}  // namespace interpolated_motion::silverlode
