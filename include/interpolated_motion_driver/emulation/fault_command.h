#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/limits.h"

namespace interpolated_motion::emulation {

/// A number that a command takes.
struct FaultNumber {
  const char* name;   ///< as people read it: "SECONDS"
  double low;         ///< included
  double high;        ///< included
  bool whole = true;  ///< no fraction
};

/// Ranges that several commands have in common: of a time off, an error of a crystal, on or off, how many.
constexpr FaultNumber kFaultSeconds{"SECONDS", 0.0, kLongestOff, false};
constexpr FaultNumber kFaultPpm{"PPM", -kLargestClockError, kLargestClockError, false};
constexpr FaultNumber kFaultSwitch{"0|1", 0.0, 1.0};
constexpr FaultNumber kFaultCount{"COUNT", 0.0, 1e6};

/// A way in which an emulated drive or bus can be made to fail, and the words that ask for it.
struct FaultCommand {
  using Numbers = std::vector<double>;

  std::string name;                          ///< "power_cycle", "fault over_voltage"
  std::vector<FaultNumber> numbers;          ///< all must be given, in this order
  std::function<void(const Numbers&)> obey;  ///< given as many as `numbers` has, each within its range
  /// Of a command that takes all that is behind its name as it stands; it has no numbers then. Returns why it
  /// is refused.
  std::function<std::optional<std::string>(const std::string&)> obey_text = {};
};

/// Obeys `text`, a name and its numbers in C notation ("power_cycle 0.5"), which is one of `known`. Returns
/// why not: nothing is done if it is none of them, or a number is unreadable or out of its range.
std::optional<std::string> obey_fault(const std::string& text, const std::vector<FaultCommand>& known);

}  // namespace interpolated_motion::emulation
