#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::emulation {

using Bytes = std::vector<std::uint8_t>;

inline canopen::Frame make_frame(std::uint32_t id, std::initializer_list<unsigned> bytes) {
  canopen::Frame frame;
  frame.id = id;
  for (const unsigned byte : bytes) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  return frame;
}

inline canopen::Frame make_remote(std::uint32_t id, std::uint8_t length) {
  canopen::Frame frame;
  frame.id = id;
  frame.remote = true;
  frame.length = length;
  return frame;
}

inline Bytes bytes_of(const canopen::Frame& frame) {
  return {frame.data.begin(), frame.data.begin() + frame.length};
}

inline HostDuration ms(double value) { return host_duration(value * 1e-3); }

/// A host that knows a drive only by what is on the wire, and a world with one bus for it.
class WireHost {
 public:
  explicit WireHost(const EposParameters& parameters = {}) : bus(world.add_can_bus("can0", 1'000'000)) {
    drive = &world.add<EposDrive>(bus, parameters);
    node = parameters.node_id;
  }

  explicit WireHost(const CyclicParameters& parameters) : bus(world.add_can_bus("can0", 1'000'000)) {
    cyclic = &world.add<CyclicDrive>(bus, parameters);
    node = parameters.node_id;
  }

  /// Runs for `length`; what the drives said is appended to `seen`.
  void run(HostDuration length) { run_to(world.now() + length); }

  void run_to(HostTime end) {
    while (world.now() < end) {
      world.advance(end);
      while (const auto frame = world.can_bus("can0").receive()) {
        if (!frame->own) seen.push_back(*frame);
      }
    }
  }

  void boot() {
    run(ms(205));
    seen.clear();
  }

  void send(const canopen::Frame& frame) { ASSERT_TRUE(world.can_bus("can0").send(frame, world.now())); }
  void send(std::uint32_t id, std::initializer_list<unsigned> bytes) { send(make_frame(id, bytes)); }

  /// First frame with this identifier, removed from `seen`.
  std::optional<canopen::ReceivedFrame> take(std::uint32_t id) {
    for (auto it = seen.begin(); it != seen.end(); ++it) {
      if (it->frame.id != id) continue;
      const canopen::ReceivedFrame found = *it;
      seen.erase(it);
      return found;
    }
    return std::nullopt;
  }

  std::size_t count(std::uint32_t id) const {
    std::size_t n = 0;
    for (const auto& frame : seen) n += frame.frame.id == id ? 1 : 0;
    return n;
  }

  /// One SDO exchange: the bytes of the drive's response, empty when there was none within 5 ms.
  Bytes exchange(std::initializer_list<unsigned> request) {
    while (take(0x580U + node)) {
    }
    canopen::Frame frame = make_frame(0x600U + node, request);
    frame.length = 8;
    send(frame);
    for (int i = 0; i < 20; ++i) {
      run(ms(0.25));
      if (const auto response = take(0x580U + node)) return bytes_of(response->frame);
    }
    return {};
  }

  /// Writes `size` bytes (1..4) by an expedited download; the abort code, 0 when it succeeded.
  std::uint32_t write(unsigned index, unsigned sub, std::int64_t value, unsigned size) {
    const auto v = static_cast<std::uint64_t>(value);
    const auto byte = [v](int i) { return static_cast<unsigned>((v >> (8 * i)) & 0xFF); };
    const Bytes r = exchange(
        {0x23U | (4 - size) << 2, index & 0xFF, index >> 8, sub, byte(0), byte(1), byte(2), byte(3)});
    return result(r, 0x60);
  }

  /// Abort code of a response, 0 when its command byte is `expected`.
  static std::uint32_t result(const Bytes& r, std::uint8_t expected) {
    if (r.size() != 8) return 0xFFFFFFFF;
    if (r[0] == 0x80) return word(r, 4);
    return r[0] == expected ? 0 : 0xFFFFFFFE;
  }

  static std::uint32_t word(const Bytes& b, std::size_t at) {
    return b[at] | static_cast<std::uint32_t>(b[at + 1]) << 8 | static_cast<std::uint32_t>(b[at + 2]) << 16 |
           static_cast<std::uint32_t>(b[at + 3]) << 24;
  }

  /// Reads an object of up to 4 bytes, unsigned; fails the test on an abort.
  std::uint32_t read(unsigned index, unsigned sub) {
    const Bytes r = exchange({0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0});
    EXPECT_EQ(r.size(), 8U);
    if (r.size() != 8) return 0xDEADBEEF;
    EXPECT_NE(r[0], 0x80) << std::hex << index << ":" << sub << " aborted with " << word(r, 4);
    const unsigned unused = (r[0] >> 2) & 3U;
    return word(r, 4) & (0xFFFFFFFFU >> (8 * unused));
  }

  std::uint32_t read_abort(unsigned index, unsigned sub) {
    return result(exchange({0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0}), 0);
  }

  void control(unsigned word) { ASSERT_EQ(write(0x6040, 0, word, 2), 0U); }
  std::uint32_t status() { return read(0x6041, 0); }
  void nmt(unsigned command) {
    send(0x000, {command, node});
    run(ms(1));
  }

  /// RPDO1 carries records, as every driver maps it.
  void map_records() {
    const unsigned low = node;
    ASSERT_EQ(write(0x1400, 1, 0x80000200 + low, 4), 0U);
    ASSERT_EQ(write(0x1600, 0, 0, 1), 0U);
    ASSERT_EQ(write(0x1600, 1, 0x20C10040, 4), 0U);
    ASSERT_EQ(write(0x1600, 0, 1, 1), 0U);
    ASSERT_EQ(write(0x1400, 1, 0x200 + low, 4), 0U);
  }

  /// "Typical command sequence" up to the point where records may be sent.
  void prepare() {
    boot();
    map_records();
    nmt(1);
    ASSERT_EQ(write(0x6060, 0, 7, 1), 0U);
    control(0x06);
    control(0x0F);
    ASSERT_EQ(write(0x60C4, 6, 1, 1), 0U);
  }

  void record(std::int32_t position, std::int32_t velocity, unsigned time) {
    const auto p = static_cast<std::uint32_t>(position);
    const auto v = static_cast<std::uint32_t>(velocity);
    send(0x200U + node,
         {p & 0xFF, p >> 8 & 0xFF, p >> 16 & 0xFF, p >> 24, v & 0xFF, v >> 8 & 0xFF, v >> 16 & 0xFF, time});
  }

  World world;
  transport::VirtualCanBus& bus;
  EposDrive* drive = nullptr;     ///< one of the two
  CyclicDrive* cyclic = nullptr;  ///< the other
  unsigned node = 1;
  std::vector<canopen::ReceivedFrame> seen;
};

}  // namespace interpolated_motion::emulation
