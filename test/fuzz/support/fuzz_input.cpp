#include "fuzz/support/fuzz_input.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace interpolated_motion::fuzz {
namespace {

using Limits = std::numeric_limits<double>;

constexpr std::array kTroublesome{0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  1e-300,
                                  1e-9,
                                  1e9,
                                  1e12,
                                  1e18,
                                  1e19,
                                  -1e19,
                                  1e150,
                                  1e308,
                                  Limits::max(),
                                  Limits::lowest(),
                                  Limits::denorm_min(),
                                  Limits::infinity(),
                                  -Limits::infinity(),
                                  Limits::quiet_NaN()};

}  // namespace

double FuzzInput::number() {
  const std::uint8_t sort = byte();
  if (sort >= 64) return (static_cast<std::int16_t>(word())) * 0.001;
  if (sort >= 32) return kTroublesome.at(sort % kTroublesome.size());
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(byte()) << (8 * i);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::vector<double> FuzzInput::numbers(unsigned count) {
  std::vector<double> values(below(count + 1));
  for (double& value : values) value = number();
  return values;
}

std::string FuzzInput::text(std::size_t size) {
  const auto* begin = reinterpret_cast<const char*>(next_);
  size = std::min(size, static_cast<std::size_t>(end_ - next_));
  next_ += size;
  return {begin, size};
}

std::string FuzzInput::line(std::size_t longest) {
  const std::uint8_t* feed = std::find(next_, end_, '\n');
  const bool found = feed != end_;
  std::string taken = text(std::min(longest, static_cast<std::size_t>(feed - next_)));
  if (found && next_ == feed) ++next_;
  return taken;
}

}  // namespace interpolated_motion::fuzz
