#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace interpolated_motion::emulation {

/// A packet of the 8-bit ASCII protocol, `@address command parameter ... CR`, all numbers decimal ("Serial
/// Communications", QCI-TD053).
struct Packet {
  static constexpr std::size_t kMaximumParameters = 15;  ///< numbers behind that of the command

  bool well_formed = true;    ///< false: something else than digits, signs and spaces in it, or too long
  bool too_long = false;      ///< more numbers than that; not well formed then
  std::int64_t address = -1;  ///< -1: none
  std::int64_t command = 0;   ///< 0 (POL) when the packet ends after the address
  std::array<std::int64_t, kMaximumParameters> parameters{};  ///< as they were sent, within +-1e11
  std::size_t parameter_count = 0;                            ///< of `parameters`, 0..kMaximumParameters
};

/// Makes packets of characters. Tolerates what hosts send: several spaces in a row, spaces before the CR, LF
/// anywhere; everything outside a packet (the answers of other drives) is passed over.
class PacketParser {
 public:
  /// Whether this character, an '@', comes in the midst of a packet, which is lost then.
  bool cuts_short(char value) const { return inside_ && value == '@'; }

  /// The packet that this character, a CR, has completed; nothing after any other character.
  std::optional<Packet> on_character(char value);

  /// Forgets the packet that is under way.
  void reset() { inside_ = false; }

 private:
  void begin();
  void digit(int value);
  void end_number();
  void store(std::int64_t value);

  Packet packet_;
  bool inside_ = false;
  std::size_t numbers_ = 0;
  bool in_number_ = false;
  bool negative_ = false;
  bool has_digits_ = false;
  std::int64_t value_ = 0;
};

}  // namespace interpolated_motion::emulation
