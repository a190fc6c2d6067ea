#include "interpolated_motion_driver/emulation/silverdust/answer.h"

#include <fmt/format.h>

#include <iterator>

namespace interpolated_motion::emulation {

Answer Answer::nak(NakCode code) {
  Answer answer(Kind::Nak);
  answer.code_ = code;
  return answer;
}

Answer Answer::data(std::uint16_t echo) {
  Answer answer(Kind::Data);
  answer.echo_ = echo;
  return answer;
}

Answer Answer::word(Command command, std::uint16_t value) {
  Answer answer = data(static_cast<std::uint16_t>(command));
  answer.add_word(value);
  return answer;
}

void Answer::add_long(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  add_word(static_cast<std::uint16_t>(bits >> 16));
  add_word(static_cast<std::uint16_t>(bits & 0xFFFF));
}

void Answer::append_to(std::string& text, int address, std::uint16_t command) const {
  const auto out = std::back_inserter(text);
  if (kind_ == Kind::Nak) {
    fmt::format_to(out, "! {:02X} {:04X} {:04X}", address, command, static_cast<unsigned>(code_));
  } else if (kind_ == Kind::Data) {
    fmt::format_to(out, "# {:02X} {:04X}", address, echo_);
    for (std::size_t i = 0; i < word_count_; ++i) fmt::format_to(out, " {:04X}", words_[i]);
  } else {
    fmt::format_to(out, "* {:02X}", address);
  }
  text.push_back('\r');
}

}  // namespace interpolated_motion::emulation
