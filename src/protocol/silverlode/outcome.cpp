#include "interpolated_motion_driver/protocol/silverlode/outcome.h"

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::silverlode {

std::optional<std::uint16_t> Outcome::word(std::size_t n) const {
  if (n >= word_count) return std::nullopt;
  return words[n];
}

std::optional<std::int32_t> Outcome::register_value(std::size_t n) const {
  if (2 * n + 1 >= word_count) return std::nullopt;
  return silverlode::register_value(words[2 * n], words[2 * n + 1]);
}

std::optional<std::uint16_t> Outcome::polling_status() const {
  if (request.command != Command::POL && request.command != Command::POR) return std::nullopt;
  if (kind == OutcomeKind::Acknowledged) return std::uint16_t{0};
  return word();
}

}  // namespace interpolated_motion::silverlode
