#include "simulation/script.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

[[noreturn]] void refuse(const std::string& line, const std::string& why) {
  throw std::invalid_argument(fmt::format("script line \"{}\": {}", line, why));
}

double read_number(const std::string& text, const std::string& line) {
  std::size_t read = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != text.size()) refuse(line, fmt::format("\"{}\" is not a number", text));
  return value;
}

void read_numbers(std::istringstream& words, const std::string& line, Event& event) {
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) refuse(line, fmt::format("\"{}\" should be NAME=NUMBER", word));
    event.numbers[word.substr(0, equals)] = read_number(word.substr(equals + 1), line);
  }
}

Event read_event(std::istringstream& words, const std::string& line) {
  Event event;
  std::string time;
  if (!(words >> time >> event.verb)) refuse(line, "an event is: at SECONDS VERB ...");
  event.time = read_number(time, line);
  if (event.verb != "inject") {
    read_numbers(words, line, event);
    return event;
  }
  if (!(words >> event.target)) refuse(line, "inject needs a joint or a bus");
  std::getline(words >> std::ws, event.command);
  return event;
}

void read_line(const std::string& line, Script& script) {
  std::istringstream words(line);
  std::string word;
  words >> word;
  if (word.empty() || word.front() == '#') return;
  if (word == "configuration") {
    std::getline(words >> std::ws, script.configuration);
  } else if (word == "at_once") {
    script.at_once = true;
  } else if (word == "at") {
    script.events.push_back(read_event(words, line));
  } else {
    refuse(line, "a line begins with configuration, at_once or at");
  }
}

}  // namespace

std::string to_text(const Event& event) {
  std::string text = fmt::format("at {} {}", event.time, event.verb);
  if (event.verb == "inject") return text + fmt::format(" {} {}", event.target, event.command);
  for (const auto& [name, value] : event.numbers) text += fmt::format(" {}={}", name, value);
  return text;
}

std::string to_text(const Script& script) {
  std::string text = "configuration " + script.configuration + "\n";
  if (script.at_once) text += "at_once\n";
  for (const Event& event : script.events) text += to_text(event) + "\n";
  return text;
}

Script parse_script(const std::string& text) {
  Script script;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) read_line(line, script);
  if (script.configuration.empty())
    throw std::invalid_argument("a script needs a line \"configuration YAML\"");
  std::stable_sort(script.events.begin(), script.events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  return script;
}

}  // namespace interpolated_motion::simulation
