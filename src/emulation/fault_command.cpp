#include "interpolated_motion_driver/emulation/fault_command.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

namespace interpolated_motion::emulation {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// What is behind the command's name, if the words begin with it.
std::optional<Words> behind_name(const FaultCommand& command, const Words& words) {
  const Words name = words_of(command.name);
  if (words.size() < name.size() || !std::equal(name.begin(), name.end(), words.begin())) return std::nullopt;
  return Words(words.begin() + static_cast<std::ptrdiff_t>(name.size()), words.end());
}

std::optional<double> read(const FaultNumber& number, const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  const bool readable = end != word.c_str() && *end == '\0' && value >= number.low && value <= number.high;
  return readable && (!number.whole || value == std::floor(value)) ? std::optional(value) : std::nullopt;
}

std::optional<std::string> obey(const FaultCommand& command, const std::string& text, const Words& words) {
  FaultCommand::Numbers values;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const FaultNumber& number = command.numbers[i];
    const auto value = read(number, words[i]);
    if (!value) {
      return fmt::format("\"{}\": {} is {}; it must be a {}number within {}..{}", text, number.name, words[i],
                         number.whole ? "whole " : "", number.low, number.high);
    }
    values.push_back(*value);
  }
  command.obey(values);
  return std::nullopt;
}

std::string shown(const FaultCommand& command) {
  std::string text = command.name;
  for (const FaultNumber& number : command.numbers) text += fmt::format(" {}", number.name);
  return command.obey_text ? text + " TEXT" : text;
}

}  // namespace

std::optional<std::string> obey_fault(const std::string& text, const std::vector<FaultCommand>& known) {
  const Words words = words_of(text);
  std::string names;
  for (const FaultCommand& command : known) {
    const auto arguments = behind_name(command, words);
    if (arguments && command.obey_text && text.size() > command.name.size())
      return command.obey_text(text.substr(command.name.size() + 1));
    if (arguments && !command.obey_text && arguments->size() == command.numbers.size())
      return obey(command, text, *arguments);
    names += (names.empty() ? "" : ", ") + shown(command);
  }
  return fmt::format("\"{}\" is no fault; known: {}", text, names);
}

}  // namespace interpolated_motion::emulation
