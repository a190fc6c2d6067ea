#include "interpolated_motion_driver/commissioning/line_scan.h"

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

namespace interpolated_motion::commissioning {
namespace {

using silverlode::Outcome;
using silverlode::OutcomeKind;
using silverlode::UnexpectedLine;

/// Times who has answered is asked for what does not change: one of two drives that share an address gives
/// itself away by an answer that is spoilt, or comes twice.
constexpr int kRepetitions = 3;

/// Answers of which one may be noise.
constexpr std::uint64_t kManyAnswers = 2;

bool somebody(const Outcome& outcome) {
  return outcome.accepted() || outcome.kind == OutcomeKind::Refused || outcome.kind == OutcomeKind::Garbled;
}

/// A look at an address is one attempt: nobody is there in most cases.
silverlode::Request once(silverlode::Request request) {
  request.repeatable = false;
  return request;
}

void identify(LineSession& session, LineDevice& device) {
  const std::uint8_t address = device.address;
  const Outcome status = session.ask(silverlode::ris_request(address));
  device.internal_status = status.word();
  device.position =
      session.ask(silverlode::rrg_request(address, silverlode::registers::kActualPosition)).register_value();
  for (int i = 0; i < kRepetitions; ++i) session.ask(once(silverlode::rvn_request(address)));
  const silverlode::LinkStatistics& statistics = session.device(address).statistics();
  const bool shared = statistics.second_replies >= kManyAnswers || statistics.garbled >= kManyAnswers;
  if (!shared) return;
  device.trouble = fmt::format(
      "its answers are spoilt or come twice ({} garbled, {} too many of {} requests): two drives have "
      "address {}, "
      "or the line is disturbed. Disconnect one, give it another address by IDT, and scan again",
      statistics.garbled, statistics.second_replies, statistics.sent, address);
}

std::vector<std::string> line_remarks(const LineSession& session) {
  std::vector<std::string> texts;
  const auto& master = session.master();
  const std::uint64_t late = master.unexpected(UnexpectedLine::NoRequest).count +
                             master.unexpected(UnexpectedLine::WrongAddress).count;
  if (late >= kManyAnswers) {
    texts.push_back(fmt::format(
        "{} replies came when none was awaited: drives that answer late (ADL). Scan again with a longer "
        "--timeout than {:.3f} s",
        late, seconds(master.parameters().reply_timeout)));
  }
  const auto& noise = master.unexpected(UnexpectedLine::Malformed);
  if (noise.count > 0) {
    texts.push_back(fmt::format(
        "lines that were no replies: {}, the last \"{}\": another rate, another protocol, or noise",
        noise.count, noise.last.printable()));
  }
  return texts;
}

}  // namespace

LineScan scan_line(LineSession& session, const Progress& progress) {
  LineScan scan;
  for (std::uint8_t address = 1; address <= silverlode::kMaxAddress; ++address) {
    Outcome outcome = session.ask(once(silverlode::rvn_request(address)));
    // Noise comes once.
    if (outcome.kind == OutcomeKind::Garbled) outcome = session.ask(once(silverlode::rvn_request(address)));
    if (somebody(outcome)) {
      LineDevice device;
      device.address = address;
      device.revision = outcome.word();
      identify(session, device);
      scan.devices.push_back(device);
    }
    if (progress) progress(address, silverlode::kMaxAddress);
  }
  scan.characters = session.characters();
  scan.remarks = line_remarks(session);
  return scan;
}

std::string to_text(const LineDevice& device) {
  const auto line = [](const char* title, const std::string& text) {
    return fmt::format("\n    {:<12}{}", title, text);
  };
  std::string text = fmt::format("address {}: QuickSilver SilverLode", device.address);
  text += device.revision ? fmt::format(", revision {}", *device.revision) : ", revision not told";
  if (device.internal_status)
    text += line("state", silverlode::InternalStatus{*device.internal_status}.text());
  if (device.position) text += line("position", fmt::format("{} counts", *device.position));
  text += line("this driver", device.trouble.empty() ? "can be used, type: silverlode_ims"
                                                     : "cannot be used: " + device.trouble);
  return text;
}

std::vector<std::string> silent_line_advice(std::uint32_t baud, std::uint64_t characters,
                                            std::uint32_t found_at) {
  if (found_at != 0) {
    return {fmt::format(
        "nobody answers at {} bit/s, but at {}: give --baud {}, and `baud: {}` in the configuration", baud,
        found_at, found_at, found_at)};
  }
  if (characters > 0) {
    return {
        fmt::format("{} characters were heard at {} bit/s, but no reply: another protocol than 8-bit ASCII "
                    "(PRO), or wires that "
                    "are exchanged. A request that comes back is this host's own",
                    characters, baud)};
  }
  return {
      "the line is silent at every rate. Check the power of the drives, the cable (A and B of RS-485, or TX "
      "and RX), "
      "and that they speak 8-bit ASCII"};
}

}  // namespace interpolated_motion::commissioning
