#include "options.h"

#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::emulated_drives {
namespace {

double number(const std::string& option, const std::string& text, double low, double high) {
  std::size_t read = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != text.size() || !(value >= low && value <= high)) {
    throw std::invalid_argument(
        fmt::format("{}: \"{}\" is not a number within {}..{}", option, text, low, high));
  }
  return value;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream text(list);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

int whole_number(const std::string& option, const std::string& text, int low, int high) {
  const double value = number(option, text, low, high);
  if (value != static_cast<int>(value)) {
    throw std::invalid_argument(fmt::format("{}: \"{}\" is not a whole number", option, text));
  }
  return static_cast<int>(value);
}

void check(const Options& options) {
  if (options.interface.empty())
    throw std::invalid_argument("--can INTERFACE is missing, such as --can vcan0");
  if (options.nodes.empty() == options.config_file.empty()) {
    throw std::invalid_argument("say which drives: either --epos 1,2,3 or --config FILE");
  }
  if (options.config_file.empty() && !options.bus.empty()) {
    throw std::invalid_argument("--bus names a bus of --config FILE");
  }
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  constexpr double kLargestClockError = 1e5;
  Options options;
  const std::map<std::string, std::function<void(const std::string&, const std::string&)>> known = {
      {"--can", [&](const auto&, const auto& value) { options.interface = value; }},
      {"--config", [&](const auto&, const auto& value) { options.config_file = value; }},
      {"--bus", [&](const auto&, const auto& value) { options.bus = value; }},
      {"--bitrate",
       [&](const auto& name, const auto& value) {
         options.bitrate = static_cast<std::uint32_t>(whole_number(name, value, 10'000, 1'000'000));
       }},
      {"--epos",
       [&](const auto& name, const auto& value) {
         for (const auto& word : split(value)) options.nodes.push_back(whole_number(name, word, 1, 127));
       }},
      {"--clock-error-ppm", [&](const auto& name, const auto& value) {
         for (const auto& word : split(value)) {
           options.clock_errors.push_back(number(name, word, -kLargestClockError, kLargestClockError));
         }
       }}};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    if (name == "--help" || name == "-h") {
      options.help = true;
      return options;
    }
    const auto option = known.find(name);
    if (option == known.end()) throw std::invalid_argument(fmt::format("unknown argument {}", name));
    if (++i == arguments.size()) throw std::invalid_argument(name + " needs a value");
    option->second(name, arguments[i]);
  }
  check(options);
  return options;
}

std::string usage() {
  return "emulated_drives --can INTERFACE (--epos NODE[,NODE...] | --config FILE [--bus NAME])\n"
         "                [--clock-error-ppm PPM[,PPM...]] [--bitrate BIT/S]\n"
         "Serves emulated maxon EPOS2 drives on a SocketCAN interface, for any CANopen master.\n"
         "  --can INTERFACE      such as vcan0; it may come and go while the program runs\n"
         "  --epos NODES         node ids of drives as delivered\n"
         "  --config FILE        the drives of a driver configuration, with their emulation: settings\n"
         "  --bus NAME           those on this bus (default: the only one)\n"
         "  --clock-error-ppm    of each drive's crystal, or one value for all\n"
         "  --bitrate BIT/S      of the bus modelled on an interface without bit timing (default: of the\n"
         "                       configuration, else 1000000); an interface with bit timing must have it\n"
         "Faults: a line on the standard input is TARGET COMMAND, where TARGET is a joint or a node id\n"
         "(emcy CODE, power_cycle SECONDS, stall 0|1, silence 0|1, clock PPM) or the interface (drop COUNT,\n"
         "drop_id ID COUNT, disconnect 0|1, bus_off SECONDS). Each is answered by a line.\n"
         "Ends by SIGINT or SIGTERM with exit code 0; 2: wrong arguments or configuration.\n";
}

}  // namespace interpolated_motion::emulated_drives
