#include "interpolated_motion_driver/transport/can_frame_bits.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace interpolated_motion::transport {
namespace {

canopen::Frame data_frame(std::uint32_t id, std::uint8_t length, std::uint8_t fill) {
  canopen::Frame frame;
  frame.id = id;
  frame.length = length;
  for (std::size_t i = 0; i < length; ++i) frame.data[i] = fill;
  return frame;
}

void append(std::vector<bool>& bits, std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i) bits.push_back(((value >> i) & 1) != 0);
}

// The frame bit by bit as ISO 11898-1 draws it: an independent second way to the same number.
int counted_bits(const canopen::Frame& frame) {
  std::vector<bool> bits{false};
  if (frame.extended) {
    append(bits, frame.id >> 18, 11);
    append(bits, 3, 2);
    append(bits, frame.id & 0x3FFFF, 18);
    append(bits, frame.remote ? 4 : 0, 3);
  } else {
    append(bits, frame.id, 11);
    append(bits, frame.remote ? 4 : 0, 3);
  }
  append(bits, frame.length, 4);
  for (std::size_t i = 0; i < frame.length && !frame.remote; ++i) append(bits, frame.data[i], 8);
  unsigned crc = 0;
  for (const bool bit : bits) {
    const bool next = bit != (((crc >> 14) & 1) != 0);
    crc = (crc << 1) & 0x7FFF;
    if (next) crc ^= 0x4599;
  }
  append(bits, crc, 15);
  std::vector<bool> wire;
  int run = 0;
  for (const bool bit : bits) {
    run = !wire.empty() && wire.back() == bit ? run + 1 : 1;
    wire.push_back(bit);
    if (run < 5) continue;
    wire.push_back(!bit);
    run = 1;
  }
  return static_cast<int>(wire.size()) + 13;
}

// Published lengths of interpolation records, made with a bit-exact frame builder on identifier 0x201.
TEST(CanFrameBits, PublishedLengths) {
  EXPECT_EQ(can_frame_bits(data_frame(0x201, 8, 0x00)), 125);
  EXPECT_EQ(can_frame_bits(data_frame(0x201, 8, 0xFF)), 124);
  canopen::Frame one_millisecond = data_frame(0x201, 8, 0x00);
  one_millisecond.data[7] = 1;
  EXPECT_EQ(can_frame_bits(one_millisecond), 126);
}

// SYNC: SOF 0, identifier 00010000000, RTR, IDE and r0 000, DLC 0000. The remainder is that of the polynomial
// division of these 19 bits times x^15 by x^15 + 0x4599.
TEST(CanFrameBits, SyncFrame) {
  const canopen::Frame sync = data_frame(0x080, 0, 0);
  EXPECT_EQ(can_crc15(sync), 0x1C05);
  EXPECT_EQ(can_frame_bits(sync), 51);
}

TEST(CanFrameBits, AgreesWithCountingBitsOnRandomFrames) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    canopen::Frame frame;
    frame.extended = random() % 4 == 0;
    frame.remote = random() % 8 == 0;
    frame.id = static_cast<std::uint32_t>(random()) & (frame.extended ? 0x1FFFFFFFU : 0x7FFU);
    frame.length = static_cast<std::uint8_t>(random() % 9);
    const std::uint64_t mask = random() % 2 == 0 ? 0x8080808080808080ULL : ~0ULL;
    const std::uint64_t data = random() & mask;
    for (std::size_t k = 0; k < 8; ++k) frame.data[k] = static_cast<std::uint8_t>(data >> (8 * k));
    const int bits = can_frame_bits(frame);
    ASSERT_EQ(bits, counted_bits(frame)) << "frame " << i;
    if (frame.extended || frame.remote) continue;
    // 44 + 8 n bits, 3 of interframe space, at most floor((34 + 8 n - 1) / 4) stuff bits (Tindell, Davis).
    EXPECT_GE(bits, 47 + 8 * frame.length);
    EXPECT_LE(bits, 47 + 8 * frame.length + (33 + 8 * frame.length) / 4);
  }
}

}  // namespace
}  // namespace interpolated_motion::transport
