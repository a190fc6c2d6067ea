#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace interpolated_motion::silverlode {

/// Registers of a drive are 0..255.
inline constexpr std::uint16_t kLastRegister = 255;

/// What a register is, as far as the documents at hand say: QCI-TD044 (17 to 19), the Command Reference (20
/// to 24, 39, 40), the rest as programs of others use them.
struct RegisterFacts {
  std::uint16_t number;  ///< 0..kLastRegister
  const char* name;      ///< such as "actual_position"
  const char* unit;      ///< "" where it is a bare number
  bool writable;         ///< by a host, while no motion uses it
  bool parameter;        ///< it keeps what a host has written; others are values of the drive
};

/// What is known of register `number`: of a register that is the user's, its number and no name.
RegisterFacts register_facts(std::uint16_t number);

/// The register of a number, "12", or a name, "actual_position"; empty for what is neither.
std::optional<std::uint16_t> find_register(const std::string& text);
/// The name spelled most like `text`; empty when none is near.
std::string closest_register(const std::string& text);

}  // namespace interpolated_motion::silverlode
