#include "interpolated_motion_driver/protocol/silverlode/line_text.h"

#include <fmt/format.h>

namespace interpolated_motion::silverlode {
namespace {

bool is_line_end(char c) { return c == '\r' || c == '\n'; }

std::string printable_character(char c) {
  if (c >= ' ' && c <= '~') return {c};
  return fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
}

}  // namespace

std::string LineText::printable() const {
  std::string_view rest = view();
  while (complete() && !rest.empty() && is_line_end(rest.back())) rest.remove_suffix(1);
  std::string text;
  for (const char c : rest) text += printable_character(c);
  if (!complete()) text += "...";
  return text;
}

}  // namespace interpolated_motion::silverlode
