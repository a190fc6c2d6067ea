#include "interpolated_motion_driver/transport/can_frame_bits.h"

#include <array>

namespace interpolated_motion::transport {
namespace {

constexpr std::uint16_t kPolynomial = 0x4599;
constexpr std::uint16_t kCrcMask = 0x7FFF;

constexpr std::uint16_t crc_bit(std::uint16_t crc, bool bit) {
  const bool feedback = bit != (((crc >> 14) & 1) != 0);
  const auto shifted = static_cast<std::uint16_t>((crc << 1) & kCrcMask);
  return feedback ? static_cast<std::uint16_t>(shifted ^ kPolynomial) : shifted;
}

constexpr std::array<std::uint16_t, 256> make_crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    std::uint16_t crc = 0;
    for (int bit = 7; bit >= 0; --bit) crc = crc_bit(crc, ((byte >> bit) & 1U) != 0);
    table[byte] = crc;
  }
  return table;
}

// The stuffing rule as a machine: the state is the last bit on the wire and how many equal ones stand at the
// end (1..5). A fifth equal bit is followed by a stuff bit of the other kind, with which a new run begins.
struct StuffStep {
  std::uint8_t state;
  std::uint8_t stuffed;
};

constexpr int kStates = 10;
constexpr std::uint8_t state_of(bool bit, int run) {
  return static_cast<std::uint8_t>((bit ? 5 : 0) + run - 1);
}

constexpr StuffStep stuff_bit(std::uint8_t state, bool bit) {
  const bool last = state >= 5;
  const int run = state % 5 + 1;
  if (bit != last) return {state_of(bit, 1), 0};
  if (run + 1 < 5) return {state_of(bit, run + 1), 0};
  return {state_of(!bit, 1), 1};
}

constexpr std::array<std::array<StuffStep, 256>, kStates> make_stuff_table() {
  std::array<std::array<StuffStep, 256>, kStates> table{};
  for (std::uint8_t start = 0; start < kStates; ++start) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      StuffStep total{start, 0};
      for (int bit = 7; bit >= 0; --bit) {
        const StuffStep step = stuff_bit(total.state, ((byte >> bit) & 1U) != 0);
        total = {step.state, static_cast<std::uint8_t>(total.stuffed + step.stuffed)};
      }
      table[start][byte] = total;
    }
  }
  return table;
}

constexpr auto kCrcTable = make_crc_table();
constexpr auto kStuffTable = make_stuff_table();

/// The stuffed part of a frame, pushed bit field by bit field. The bus is recessive (1) before the start of
/// frame.
class Wire {
 public:
  void push(std::uint32_t value, int bits) {
    while (bits >= 8) {
      bits -= 8;
      push_byte(static_cast<std::uint8_t>(value >> bits));
    }
    while (bits > 0) {
      --bits;
      push_bit(((value >> bits) & 1U) != 0);
    }
  }

  std::uint16_t crc() const { return crc_; }
  int bits() const { return bits_; }

 private:
  void push_byte(std::uint8_t byte) {
    const auto top = static_cast<std::uint8_t>(crc_ >> 7);
    crc_ = static_cast<std::uint16_t>(((crc_ << 8) & kCrcMask) ^
                                      kCrcTable[static_cast<std::uint8_t>(top ^ byte)]);
    const StuffStep step = kStuffTable[state_][byte];
    state_ = step.state;
    bits_ += 8 + step.stuffed;
  }

  void push_bit(bool bit) {
    crc_ = crc_bit(crc_, bit);
    const StuffStep step = stuff_bit(state_, bit);
    state_ = step.state;
    bits_ += 1 + step.stuffed;
  }

  std::uint16_t crc_ = 0;
  std::uint8_t state_ = state_of(true, 1);
  int bits_ = 0;
};

/// From the start of frame, a 0, to the length: as few numbers as possible, whose bytes are pushed as a
/// whole.
void push_header(Wire& wire, const canopen::Frame& frame) {
  const std::uint32_t control = (frame.remote ? 1U << 6 : 0U) | (frame.length & 0xFU);
  if (frame.extended) {
    wire.push((frame.id >> 18) & 0x7FF, 1 + 11);
    wire.push(3, 2);
    wire.push(frame.id & 0x3FFFF, 18);
    wire.push(control, 3 + 4);
  } else {
    wire.push((frame.id & 0x7FF) << 7 | control, 1 + 11 + 3 + 4);
  }
}

Wire up_to_data(const canopen::Frame& frame) {
  Wire wire;
  push_header(wire, frame);
  if (!frame.remote) {
    for (std::size_t i = 0; i < frame.length && i < frame.data.size(); ++i) wire.push(frame.data[i], 8);
  }
  return wire;
}

}  // namespace

std::uint16_t can_crc15(const canopen::Frame& frame) { return up_to_data(frame).crc(); }

int can_frame_bits(const canopen::Frame& frame) {
  // CRC delimiter, acknowledge slot and delimiter, end of frame, interframe space (ISO 11898-1): never
  // stuffed.
  constexpr int kUnstuffedTail = 1 + 1 + 1 + 7 + 3;
  Wire wire = up_to_data(frame);
  wire.push(wire.crc(), 15);
  return wire.bits() + kUnstuffedTail;
}

}  // namespace interpolated_motion::transport
