#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

#include <fmt/format.h>

namespace interpolated_motion::silverlode {
namespace {

/// A bit and what it says when it is `set`.
struct BitText {
  unsigned bit;
  const char* text;
  bool set = true;
};

// What matters most comes first in the texts.
constexpr BitText kPollingTexts[] = {
    {3, "shut down by kill-motor condition"},
    {8, "moving error"},
    {9, "holding error"},
    {10, "low or over voltage"},
    {2, "soft limit"},
    {14, "non-volatile memory error"},
    {12, "command error"},
    {0, "packet aborted"},
    {1, "received checksum wrong"},
    {4, "framing error"},
    {5, "message too long"},
    {7, "receive buffer overflow"},
    {11, "motion ended by input"},
    {6, "check-status condition met"},
    {13, "motion completed"},
    {15, "immediate command done"},
};

constexpr BitText kInternalFaultTexts[] = {
    {8, "moving error"},           {9, "holding error"}, {7, "over temperature", false},
    {10, "halt command received"}, {13, "over voltage"}, {14, "low voltage"},
};

constexpr BitText kInternalTexts[] = {
    {11, "input found on last move"},
    {12, "delay expired"},
    {0, "index found"},
    {4, "input 1 high"},
    {5, "input 2 high"},
    {6, "input 3 high"},
};

constexpr BitText kIoTexts[] = {
    {8, "moving error"},
    {9, "holding error"},
    {7, "over temperature", false},
    {3, "trajectory generator active"},
    {10, "delay running"},
};

template <std::size_t N>
void append_texts(std::string& text, std::uint16_t raw, const BitText (&texts)[N]) {
  for (const BitText& t : texts) {
    if (((raw >> t.bit & 1u) != 0) != t.set) continue;
    if (!text.empty()) text += ", ";
    text += t.text;
  }
}

std::string with_number(const std::string& text, std::uint16_t raw) {
  return fmt::format("{} (0x{:04X})", text, raw);
}

}  // namespace

bool PollingStatus::fault() const {
  return kill_motor() || soft_limit() || moving_error() || holding_error() || voltage_error() ||
         memory_error();
}

bool PollingStatus::line_error() const {
  return aborted_packet() || receive_checksum_error() || framing_error() || message_too_long() ||
         receive_overflow();
}

std::string PollingStatus::text() const {
  std::string text;
  append_texts(text, raw, kPollingTexts);
  return with_number(text.empty() ? "no status" : text, raw);
}

bool InternalStatus::fault() const {
  return !temperature_ok() || moving_error() || holding_error() || halted() || over_voltage() ||
         low_voltage();
}

std::string InternalStatus::text() const {
  std::string text;
  append_texts(text, raw, kInternalFaultTexts);
  if (text.empty()) text = "no fault";
  append_texts(text, raw, kInternalTexts);
  return with_number(text, raw);
}

bool IoStatus::fault() const { return !temperature_ok() || moving_error() || holding_error(); }

std::string IoStatus::text() const {
  std::string text;
  append_texts(text, raw, kIoTexts);
  return with_number(text.empty() ? "at rest" : text, raw);
}

}  // namespace interpolated_motion::silverlode
