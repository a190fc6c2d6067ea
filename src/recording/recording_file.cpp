#include "interpolated_motion_driver/recording/recording_file.h"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/recording/recording.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::recording {

namespace {

void read_head(const std::string& text, RecordingFile& file) {
  const YAML::Node head = YAML::Load(text);
  if (!head.IsMap()) throw std::invalid_argument("there is no version above ---: it is no recording");
  for (const char* key : {"version", "cause", "begin", "end", "complete", "limits", "configuration"})
    if (!head[key]) throw std::invalid_argument(fmt::format("there is no {} above ---", key));
  const int version = head["version"].as<int>();
  if (version != kFormatVersion)
    throw std::invalid_argument(fmt::format("version is {}; this program reads {}", version, kFormatVersion));
  file.cause = head["cause"].as<std::string>();
  file.begin = parse_time(head["begin"].as<std::string>());
  file.end = parse_time(head["end"].as<std::string>());
  file.complete = head["complete"].as<bool>();
  file.configuration = head["configuration"];
  file.limits = parse_limits(head["limits"]);
}

void read_line(const std::string& line, RecordingFile& file) {
  std::istringstream words(line);
  std::string time;
  std::string kind;
  words >> time >> kind;
  if (kind == "order") {
    RecordedOrder order;
    order.time = parse_time(time);
    words >> order.verb;
    std::string arguments;
    std::getline(words, arguments);
    order.arguments = YAML::Load(arguments);
    file.orders.push_back(order);
  } else if (kind == "group") {
    const std::string mark = " -> fault: ";
    const std::size_t at = line.find(mark);
    if (at != std::string::npos) file.faults.push_back({parse_time(time), line.substr(at + mark.size())});
  }
}

/// Calls `read` and tells of which line it has complained.
template <class Read>
void at_line(int number, const Read& read) {
  try {
    read();
  } catch (const std::exception& error) {
    throw std::invalid_argument(fmt::format("line {} of the recording: {}", number, error.what()));
  }
}

}  // namespace

RecordingFile parse_recording(const std::string& text) {
  RecordingFile file;
  std::istringstream lines(text);
  std::string head;
  int number = 1;
  std::string line;
  for (; std::getline(lines, line) && line != "---"; ++number) head += line + "\n";
  at_line(number, [&] { read_head(head, file); });
  for (++number; std::getline(lines, line); ++number) at_line(number, [&] { read_line(line, file); });
  return file;
}

}  // namespace interpolated_motion::recording
