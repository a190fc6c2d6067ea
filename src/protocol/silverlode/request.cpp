#include "interpolated_motion_driver/protocol/silverlode/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>

namespace interpolated_motion::silverlode {
namespace {

constexpr std::size_t kAckCharacters = 5;         ///< "* AA" CR
constexpr std::size_t kNakCharacters = 15;        ///< "! AA CCCC EEEE" CR
constexpr std::size_t kDataHeaderCharacters = 9;  ///< "# AA CCCC"
constexpr std::size_t kWordCharacters = 5;        ///< " DDDD"

void append(LineText& text, std::int32_t number) {
  const fmt::format_int digits(number);
  for (std::size_t i = 0; i < digits.size(); ++i) text.append(digits.data()[i]);
}

LineText request_text(std::uint8_t address, Command command, const std::int32_t* arguments,
                      std::size_t count) {
  LineText text;
  text.append('@');
  append(text, address);
  text.append(' ');
  append(text, static_cast<std::int32_t>(command));
  for (std::size_t i = 0; i < count; ++i) {
    text.append(' ');
    append(text, arguments[i]);
  }
  text.append('\r');
  return text;
}

ReplyKind reply_kind(std::uint8_t address, Command command) {
  if (address == kGlobalAddress) return ReplyKind::None;
  switch (command) {
    case Command::RST:
      return ReplyKind::None;
    case Command::POL:
      return ReplyKind::AckOrData;
    case Command::POR:
    case Command::RVN:
    case Command::RRG:
    case Command::RIS:
    case Command::RIO:
      return ReplyKind::Data;
    default:
      return ReplyKind::Ack;
  }
}

std::uint8_t reply_words(Command command, std::size_t argument_count) {
  switch (command) {
    case Command::POL:
    case Command::POR:
    case Command::RIS:
    case Command::RIO:
      return 1;
    case Command::RRG:
      return static_cast<std::uint8_t>(2 * argument_count);
    default:
      return 0;
  }
}

template <class... Arguments>
Request request_with(std::uint8_t address, Command command, Arguments... arguments) {
  const std::array<std::int32_t, sizeof...(arguments)> numbers{static_cast<std::int32_t>(arguments)...};
  return make_request(address, command, numbers.data(), numbers.size());
}

constexpr std::size_t kMaxImsArguments = 4;

[[noreturn]] void refuse_ims_arguments(std::string_view arguments) {
  throw std::invalid_argument(
      fmt::format("IMS arguments \"{}\" are not up to {} decimal numbers with one space between two",
                  std::string(arguments), kMaxImsArguments));
}

}  // namespace

std::size_t reply_characters(const Request& request) {
  const std::size_t words = request.reply_words == 0 ? kMaxReplyWords : request.reply_words;
  const std::size_t data = kDataHeaderCharacters + kWordCharacters * words + 1;
  switch (request.reply) {
    case ReplyKind::None:
      return 0;
    case ReplyKind::Ack:
      return kAckCharacters;
    case ReplyKind::Data:
    case ReplyKind::AckOrData:
      break;
  }
  return data;
}

std::size_t longest_reply_characters(const Request& request) {
  if (request.reply == ReplyKind::None) return 0;
  return std::max(reply_characters(request), kNakCharacters);
}

Request make_request(std::uint8_t address, Command command, const std::int32_t* arguments,
                     std::size_t count) {
  Request request;
  request.address = address;
  request.command = command;
  request.reply = reply_kind(address, command);
  request.reply_words = reply_words(command, count);
  request.repeatable = command != Command::IMW && command != Command::IMS;
  request.text = request_text(address, command, arguments, count);
  return request;
}

Request pol_request(std::uint8_t address) { return request_with(address, Command::POL); }
Request por_request(std::uint8_t address) { return request_with(address, Command::POR); }
Request cpl_request(std::uint8_t address, std::uint16_t mask) {
  return request_with(address, Command::CPL, mask);
}
Request hlt_request(std::uint8_t address) { return request_with(address, Command::HLT); }
Request stp_request(std::uint8_t address, std::int32_t deceleration) {
  return request_with(address, Command::STP, deceleration);
}
Request rst_request(std::uint8_t address) { return request_with(address, Command::RST); }
Request rvn_request(std::uint8_t address) { return request_with(address, Command::RVN); }
Request wri_request(std::uint8_t address, std::uint16_t register_number, std::int32_t value) {
  return request_with(address, Command::WRI, register_number, value);
}
Request ris_request(std::uint8_t address) { return request_with(address, Command::RIS); }
Request rio_request(std::uint8_t address) { return request_with(address, Command::RIO); }
Request imw_request(std::uint8_t address, std::int32_t time, std::int32_t position, std::int32_t acceleration,
                    std::int32_t velocity) {
  return request_with(address, Command::IMW, time, position, acceleration, velocity);
}
Request mav_request(std::uint8_t address, std::int32_t position, std::int32_t acceleration,
                    std::int32_t velocity) {
  return request_with(address, Command::MAV, position, acceleration, velocity, 0, 0);
}
Request ttp_request(std::uint8_t address) { return request_with(address, Command::TTP); }
Request ztp_request(std::uint8_t address) { return request_with(address, Command::ZTP); }
Request erl_request(std::uint8_t address, std::int16_t moving, std::int16_t holding, std::uint16_t delay) {
  return request_with(address, Command::ERL, moving, holding, delay);
}
Request cis_request(std::uint8_t address) { return request_with(address, Command::CIS); }
Request kmc_request(std::uint8_t address, std::uint16_t enable, std::uint16_t state) {
  return request_with(address, Command::KMC, enable, state);
}
Request adl_request(std::uint8_t address, std::uint16_t delay) {
  return request_with(address, Command::ADL, delay);
}
Request emd_request(std::uint8_t address) { return request_with(address, Command::EMD); }
Request dmd_request(std::uint8_t address) { return request_with(address, Command::DMD); }

Request ims_request(std::uint8_t address, std::string_view arguments) {
  std::array<std::int32_t, kMaxImsArguments> numbers{};
  std::size_t count = 0;
  const char* at = arguments.data();
  const char* const end = at + arguments.size();
  while (at != end) {
    if (count > 0 && *at++ != ' ') refuse_ims_arguments(arguments);
    if (count == kMaxImsArguments) refuse_ims_arguments(arguments);
    const auto [behind, error] = std::from_chars(at, end, numbers[count]);
    if (error != std::errc()) refuse_ims_arguments(arguments);
    at = behind;
    ++count;
  }
  return make_request(address, Command::IMS, numbers.data(), count);
}

Request imq_request(std::uint8_t address) { return request_with(address, Command::IMQ); }

}  // namespace interpolated_motion::silverlode
