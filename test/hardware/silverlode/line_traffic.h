#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "hardware/scenario.h"

namespace interpolated_motion::test {

/// Counts what crosses the serial lines of a scenario, as one reads it off the wire log.
class LineTraffic {
 public:
  explicit LineTraffic(Scenario& scenario) {
    scenario.driver().set_wire_observer(
        {{}, [this](const std::string&, const hardware::SerialText& line) { take(line); }});
  }

  void restart() {
    commands_ = 0;
    by_number_.clear();
    refusals_.clear();
  }

  std::uint64_t commands() const { return commands_; }
  /// Commands with a number, e.g. 25 for IMW.
  std::uint64_t commands(int number) const { return count_in(by_number_, number); }
  std::uint64_t naks() const {
    std::uint64_t all = 0;
    for (const auto& [code, count] : refusals_) all += count;
    return all;
  }
  std::uint64_t naks(int code) const { return count_in(refusals_, code); }

 private:
  static std::uint64_t count_in(const std::map<int, std::uint64_t>& counts, int key) {
    const auto found = counts.find(key);
    return found == counts.end() ? 0 : found->second;
  }

  void take(const hardware::SerialText& line) {
    const std::string text(line.text);
    if (line.from_host) {
      ++commands_;
      const auto space = text.find(' ');
      ++by_number_[space == std::string::npos ? 0 : std::stoi(text.substr(space + 1))];
    } else if (!text.empty() && text.front() == '!') {
      ++refusals_[std::stoi(text.substr(text.rfind(' ') + 1), nullptr, 16)];
    }
  }

  std::uint64_t commands_ = 0;
  std::map<int, std::uint64_t> by_number_;
  std::map<int, std::uint64_t> refusals_;
};

}  // namespace interpolated_motion::test
