#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::silverlode::test {

inline HostTime at_us(double us) { return HostTime{host_duration(us * 1e-6)}; }
inline double to_us(HostTime time) { return seconds(time.time_since_epoch()) * 1e6; }
inline constexpr HostDuration kUs = std::chrono::microseconds(1);
inline constexpr HostDuration kMs = std::chrono::milliseconds(1);

/// Of one character at 57600 bit/s, 8N2: 11 bits.
inline constexpr double kCharacterUs = 11e6 / 57600;

/// What a drive sends: `text`, its first bit `delay` after the last bit of the request.
struct Answer {
  std::string text;
  HostDuration delay = 2 * kMs;
};

/// A request as the line carried it.
struct SentRequest {
  std::string text;  ///< without the CR
  HostTime begin{};
};

/// A line master and scripted drives in virtual time, at 57600 bit/s and 11 bits a character.
class ScriptedLine {
 public:
  /// Called with every request, without its CR.
  using Script = std::function<std::vector<Answer>(const std::string& request)>;

  explicit ScriptedLine(Script script, LineParameters parameters = {})
      : master_("line0", parameters), script_(std::move(script)) {}

  LineMaster& master() { return master_; }
  HostTime now() const { return now_; }
  const std::vector<SentRequest>& sent() const { return sent_; }
  std::vector<std::string> sent_texts() const {
    std::vector<std::string> texts;
    for (const SentRequest& request : sent_) texts.push_back(request.text);
    return texts;
  }

  /// Puts characters on the line, the first bit at `begin`.
  void inject(const std::string& text, HostTime begin) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const HostDuration length = host_duration(static_cast<double>(i + 1) * kCharacterUs * 1e-6);
      characters_.emplace(begin + length, text[i]);
    }
  }

  void run_until(HostTime end) {
    int calls_without_progress = 0;
    while (true) {
      offer();
      const HostTime next = next_event();
      if (next > end) break;
      calls_without_progress = next > now_ ? 0 : calls_without_progress + 1;
      ASSERT_LT(calls_without_progress, 1000) << "the master asks to be called again and again";
      advance(std::max(now_, next));
    }
    advance(end);
  }

  void run_for(HostDuration duration) { run_until(now_ + duration); }

 private:
  void offer() {
    while (const auto text = master_.peek_outgoing(now_)) {
      ASSERT_EQ(text->back(), '\r');
      const std::string request(text->substr(0, text->size() - 1));
      const HostTime request_end =
          now_ + host_duration(static_cast<double>(text->size()) * kCharacterUs * 1e-6);
      master_.pop_outgoing(now_);
      sent_.push_back({request, now_});
      for (const Answer& answer : script_(request)) inject(answer.text, request_end + answer.delay);
    }
  }

  HostTime next_event() const {
    const HostTime deadline = master_.next_deadline();
    return characters_.empty() ? deadline : std::min(deadline, characters_.begin()->first);
  }

  void advance(HostTime now) {
    now_ = now;
    while (!characters_.empty() && characters_.begin()->first <= now) {
      master_.on_character(characters_.begin()->second, characters_.begin()->first);
      characters_.erase(characters_.begin());
    }
    master_.poll(now);
  }

  LineMaster master_;
  Script script_;
  HostTime now_{};
  std::multimap<HostTime, char> characters_;
  std::vector<SentRequest> sent_;
};

/// Answers of a drive that is well: data for the requests that ask for it, else an ACK.
inline std::string healthy_reply(const std::string& request) {
  unsigned address = 0;
  unsigned command = 0;
  std::sscanf(request.c_str(), "@%u %u", &address, &command);
  char text[40];
  switch (command) {
    case 12:
      std::snprintf(text, sizeof text, "# %02X 000C 0001 6760\r", address);
      break;
    case 20:
      std::snprintf(text, sizeof text, "# %02X 0014 00F3\r", address);
      break;
    case 21:
      std::snprintf(text, sizeof text, "# %02X 0015 0088\r", address);
      break;
    default:
      std::snprintf(text, sizeof text, "* %02X\r", address);
      break;
  }
  return text;
}

/// A drive that is well: silent to the global address.
inline std::vector<Answer> healthy(const std::string& request) {
  if (request.rfind("@255 ", 0) == 0) return {};
  return {{healthy_reply(request)}};
}
inline std::vector<Answer> silent(const std::string&) { return {}; }

/// The outcomes of a device not yet taken.
inline std::vector<Outcome> take_all(DeviceLink& device) {
  std::vector<Outcome> outcomes;
  while (const auto outcome = device.take_outcome()) outcomes.push_back(*outcome);
  return outcomes;
}

}  // namespace interpolated_motion::silverlode::test
