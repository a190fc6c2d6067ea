#include "interpolated_motion_driver/transport/can_frame_text.h"

#include <algorithm>
#include <cstdlib>

namespace interpolated_motion::transport {

namespace {

constexpr std::size_t kStandardDigits = 3;
constexpr std::size_t kExtendedDigits = 8;
constexpr std::uint32_t kHighestStandard = 0x7FF;
constexpr std::uint32_t kHighestExtended = 0x1FFFFFFF;

bool is_hex(const std::string& text) {
  return text.find_first_not_of("0123456789ABCDEFabcdef") == std::string::npos;
}

std::uint32_t number(const std::string& digits) {
  return static_cast<std::uint32_t>(std::strtoul(digits.c_str(), nullptr, 16));
}

bool take_bytes(const std::string& digits, canopen::Frame& frame) {
  if (digits.size() % 2 != 0 || digits.size() > 2 * frame.data.size() || !is_hex(digits)) return false;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    frame.data[frame.length++] = static_cast<std::uint8_t>(number(digits.substr(i, 2)));
  return true;
}

}  // namespace

std::optional<canopen::Frame> parse_frame(const std::string& text) {
  const std::size_t digits = text.find('#');
  if (digits != kStandardDigits && digits != kExtendedDigits) return std::nullopt;
  const std::string id = text.substr(0, digits);
  const std::string content = text.substr(digits + 1);
  canopen::Frame frame;
  frame.extended = digits == kExtendedDigits;
  frame.remote = content == "R";
  frame.id = number(id);
  const bool known = is_hex(id) && frame.id <= (frame.extended ? kHighestExtended : kHighestStandard);
  return known && (frame.remote || take_bytes(content, frame)) ? std::optional(frame) : std::nullopt;
}

}  // namespace interpolated_motion::transport
