#include "interpolated_motion_driver/protocol/silverlode/reply_parser.h"

#include <optional>
#include <string_view>

namespace interpolated_motion::silverlode {
namespace {

constexpr std::size_t kAddressDigits = 2;
constexpr std::size_t kWordDigits = 4;

bool starts_line(char c) { return c == '*' || c == '#' || c == '!' || c == '@'; }

void skip_spaces(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
}

std::optional<unsigned> digit_value(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  return std::nullopt;
}

/// Takes a field off the front of `text`: spaces, then exactly `digits` hexadecimal digits, then a space or
/// the end.
std::optional<std::uint16_t> take_field(std::string_view& text, std::size_t digits) {
  if (text.empty() || text.front() != ' ') return std::nullopt;
  skip_spaces(text);
  if (text.size() < digits || (text.size() > digits && text[digits] != ' ')) return std::nullopt;
  unsigned value = 0;
  for (const char c : text.substr(0, digits)) {
    const auto digit = digit_value(c);
    if (!digit) return std::nullopt;
    value = value * 16 + *digit;
  }
  text.remove_prefix(digits);
  return static_cast<std::uint16_t>(value);
}

bool at_end(std::string_view text) {
  skip_spaces(text);
  return text.empty();
}

bool take_command(std::string_view& text, Reply& reply) {
  const auto command = take_field(text, kWordDigits);
  reply.command = command.value_or(0);
  return command.has_value();
}

bool take_nak(std::string_view& text, Reply& reply) {
  reply.type = ReplyType::Nak;
  if (!take_command(text, reply)) return false;
  const auto code = take_field(text, kWordDigits);
  reply.nak = NakCode{code.value_or(0)};
  return code.has_value();
}

bool take_data(std::string_view& text, Reply& reply) {
  reply.type = ReplyType::Data;
  if (!take_command(text, reply)) return false;
  while (!at_end(text) && reply.word_count < kMaxReplyWords) {
    const auto word = take_field(text, kWordDigits);
    if (!word) return false;
    reply.words[reply.word_count++] = *word;
  }
  return reply.word_count > 0;
}

/// The fields behind the address.
bool take_rest(char start, std::string_view& text, Reply& reply) {
  if (start == '#') return take_data(text, reply);
  if (start == '!') return take_nak(text, reply);
  return start == '*';
}

}  // namespace

Parsed ReplyParser::on_character(char c, HostTime time) {
  if (c == '\n') return Parsed::Nothing;
  if (starts_line(c)) {
    start_line(c, time);
    return Parsed::Nothing;
  }
  if (ended_) {
    line_.clear();
    ended_ = false;
  }
  if (c == '\r') return end_line(time);
  line_.append(c);
  return Parsed::Nothing;
}

void ReplyParser::reset() {
  if (!ended_) dropped_characters_ += line_.length();
  line_.clear();
  ended_ = true;
}

void ReplyParser::start_line(char c, HostTime time) {
  reset();
  ended_ = false;
  line_.append(c);
  begin_ = time;
}

Parsed ReplyParser::end_line(HostTime time) {
  ended_ = true;
  if (at_end(line_.view())) return Parsed::Nothing;
  if (line_.view().front() == '@') return Parsed::Echo;
  if (!parse()) return Parsed::Malformed;
  reply_.begin = begin_;
  reply_.end = time;
  return Parsed::Reply;
}

bool ReplyParser::parse() {
  if (!line_.complete()) return false;
  std::string_view text = line_.view();
  const char start = text.front();
  text.remove_prefix(1);
  Reply reply;
  const auto address = take_field(text, kAddressDigits);
  if (!address || !take_rest(start, text, reply) || !at_end(text)) return false;
  reply.address = static_cast<std::uint8_t>(*address);
  reply_ = reply;
  return true;
}

}  // namespace interpolated_motion::silverlode
