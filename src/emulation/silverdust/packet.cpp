#include "interpolated_motion_driver/emulation/silverdust/packet.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Beyond any number of the protocol: larger ones stay here and are refused as a value.
constexpr std::int64_t kLargest = 100'000'000'000;

}  // namespace

std::optional<Packet> PacketParser::on_character(char value) {
  if (value == '@') {
    begin();
    return std::nullopt;
  }
  if (!inside_ || value == '\n') return std::nullopt;
  if (value == '\r') {
    end_number();
    inside_ = false;
    return packet_;
  }
  if (value == ' ') {
    end_number();
  } else if (value >= '0' && value <= '9') {
    digit(value - '0');
  } else if ((value == '-' || value == '+') && !in_number_) {
    in_number_ = true;
    negative_ = value == '-';
  } else {
    packet_.well_formed = false;
  }
  return std::nullopt;
}

void PacketParser::begin() {
  packet_ = Packet{};
  inside_ = true;
  numbers_ = 0;
  in_number_ = negative_ = has_digits_ = false;
  value_ = 0;
}

void PacketParser::digit(int value) {
  in_number_ = has_digits_ = true;
  value_ = std::min(value_ * 10 + value, kLargest);
}

void PacketParser::end_number() {
  if (!in_number_) return;
  if (!has_digits_) packet_.well_formed = false;
  store(negative_ ? -value_ : value_);
  in_number_ = negative_ = has_digits_ = false;
  value_ = 0;
}

void PacketParser::store(std::int64_t value) {
  const std::size_t place = numbers_++;
  if (place == 0) {
    packet_.address = value;
  } else if (place == 1) {
    packet_.command = value;
  } else if (packet_.parameter_count < Packet::kMaximumParameters) {
    packet_.parameters[packet_.parameter_count++] = value;
  } else {
    packet_.well_formed = false;
    packet_.too_long = true;
  }
}

}  // namespace interpolated_motion::emulation
