#pragma once

#include <map>
#include <string>
#include <vector>

namespace interpolated_motion::simulation {

/// Something that happens to the driver at one instant. What each verb means, and its numbers,
/// docs/simulation.md tells.
struct Event {
  double time = 0.0;  ///< s, on the script's clock
  std::string
      verb;  ///< goal, stop, cancel, halt, clear, enable, disable, reset, speed, stream, late, die, inject
  std::map<std::string, double> numbers;
  std::string target;   ///< of inject: a joint or a bus
  std::string command;  ///< of inject, see hardware/fault_injection.h

  /// The number `name`, or `otherwise` where the event does not have it.
  double number(const std::string& name, double otherwise = 0.0) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
  }
};

/// All that is decided of a simulation: an arm, and what happens to it.
struct Script {
  std::string configuration;  ///< the driver's parameters in YAML, one line
  bool at_once =
      false;  ///< the clock of the events starts with the driver; false: when the drives have been found
  std::vector<Event> events;  ///< in the order of time
};

/// One line, without its end.
std::string to_text(const Event& event);
/// As lines that parse_script() reads again to the last bit.
std::string to_text(const Script& script);
/// Throws std::invalid_argument with the line that is wrong. Empty lines and those that begin with # are
/// passed over.
Script parse_script(const std::string& text);

}  // namespace interpolated_motion::simulation
