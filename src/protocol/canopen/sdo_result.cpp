#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"

#include <fmt/format.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/frame_text.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"

namespace interpolated_motion::canopen {
namespace {

std::uint64_t number(const SdoData& data) {
  std::uint64_t bits = 0;
  for (std::size_t i = std::min<std::size_t>(data.size(), 8); i-- > 0;) bits = bits << 8 | data[i];
  return bits;
}

std::string value_text(const SdoData& data) {
  if (data.empty()) return "no data";
  if (data.size() > 8) return fmt::format("{} bytes", data.size());
  return fmt::format("0x{:0{}X}", number(data), 2 * data.size());
}

}  // namespace

void SdoData::clear() {
  large_.clear();
  size_ = 0;
}

void SdoData::append(const std::uint8_t* bytes, std::size_t count) {
  if (is_small() && size_ + count <= small_.size()) {
    std::copy_n(bytes, count, small_.begin() + static_cast<std::ptrdiff_t>(size_));
  } else {
    if (is_small()) large_.assign(small_.begin(), small_.begin() + static_cast<std::ptrdiff_t>(size_));
    large_.insert(large_.end(), bytes, bytes + count);
  }
  size_ += count;
}

void SdoData::truncate(std::size_t count) {
  if (count >= size_) return;
  size_ = count;
  if (is_small()) return;
  if (count <= small_.size()) std::copy_n(large_.begin(), count, small_.begin());
  large_.resize(count > small_.size() ? count : 0);
}

std::uint64_t SdoResult::as_u64() const { return ok ? number(data) : 0; }

std::int64_t SdoResult::as_i64() const {
  if (!ok || data.empty()) return 0;
  return sign_extend(number(data), static_cast<unsigned>(8 * std::min<std::size_t>(data.size(), 8)));
}

std::string SdoResult::as_text() const {
  std::string text;
  for (std::size_t i = 0; ok && i < data.size() && data[i] != 0; ++i) {
    text += data[i] >= 0x20 && data[i] < 0x7F ? static_cast<char>(data[i]) : '?';
  }
  return text;
}

std::string SdoResult::text() const {
  std::string text = fmt::format("node {}: {} of {}", node,
                                 direction == SdoDirection::Upload ? "read" : "write", to_string(address));
  if (ok || direction == SdoDirection::Download) text += " = " + value_text(data);
  if (ok) return text;
  text += fmt::format(" failed: abort 0x{:08X} {} (sent by {}; last sent to the drive: {})", abort_code,
                      describe_abort(abort_code), aborted_by_drive ? "the drive" : "this host",
                      to_string(last_sent));
  if (abort_code == abort_code::kTimeout && !aborted_by_drive) {
    text += fmt::format(
        "; no answer came within {:.2f} s: check the drive's power, node id and bit rate; where it answers "
        "later than that, raise sdo_timeout of the bus",
        seconds(timeout));
  }
  return text;
}

}  // namespace interpolated_motion::canopen
