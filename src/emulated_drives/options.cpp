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

std::vector<int> whole_numbers(const std::string& option, const std::string& list, int low, int high) {
  std::vector<int> numbers;
  for (const auto& word : split(list)) numbers.push_back(whole_number(option, word, low, high));
  return numbers;
}

void check_drives(const Options& options, const std::string& place, const std::vector<int>& drives,
                  const char* example) {
  const bool from_file = !options.config_file.empty();
  if (!place.empty() && drives.empty() != from_file)
    throw std::invalid_argument(fmt::format("say which drives: either {} or --config FILE", example));
  if (place.empty() && !drives.empty())
    throw std::invalid_argument(fmt::format("{}: say where, by --can INTERFACE or --serial LINK", example));
}

void check(const Options& options) {
  if (options.interface.empty() && options.link.empty() && options.config_file.empty()) {
    throw std::invalid_argument(
        "say what to serve: --can INTERFACE (such as --can vcan0), --serial LINK, or --config FILE");
  }
  check_drives(options, options.interface, options.nodes, "--epos 1,2,3");
  check_drives(options, options.link, options.addresses, "--silverlode 16,17");
  const bool one_place = options.interface.empty() != options.link.empty();
  if (!options.bus.empty() && (options.config_file.empty() || !one_place)) {
    throw std::invalid_argument(
        "--bus names the bus of --config FILE whose drives go to --can INTERFACE or --serial LINK");
  }
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  constexpr double kLargestClockError = 1e5;
  Options options;
  using Reader = std::function<void(const std::string& name, const std::string& value)>;
  const auto text = [](std::string& target) -> Reader {
    return [&target](const auto&, const auto& value) { target = value; };
  };
  const std::map<std::string, Reader> known = {
      {"--can", text(options.interface)},
      {"--serial", text(options.link)},
      {"--config", text(options.config_file)},
      {"--bus", text(options.bus)},
      {"--samples", text(options.samples_folder)},
      {"--bitrate",
       [&](const auto& name, const auto& value) {
         options.bitrate = static_cast<std::uint32_t>(whole_number(name, value, 10'000, 1'000'000));
       }},
      {"--baud",
       [&](const auto& name, const auto& value) { options.baud = whole_number(name, value, 300, 250'000); }},
      {"--epos",
       [&](const auto& name, const auto& value) { options.nodes = whole_numbers(name, value, 1, 127); }},
      {"--silverlode",
       [&](const auto& name, const auto& value) { options.addresses = whole_numbers(name, value, 1, 254); }},
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
  return "emulated_drives --config FILE\n"
         "emulated_drives --can INTERFACE  (--epos NODE[,NODE...] | --config FILE [--bus NAME])\n"
         "emulated_drives --serial LINK    (--silverlode ADDRESS[,ADDRESS...] | --config FILE [--bus NAME])\n"
         "Serves emulated maxon EPOS2 drives on a SocketCAN interface, for any CANopen master, and emulated\n"
         "QuickSilver SilverLode drives on a pseudo-terminal, for any program that opens it as a serial "
         "port.\n"
         "  --config FILE        alone: all drives of a driver configuration whose buses have transport\n"
         "                       socketcan or serial, on their interfaces and devices\n"
         "  --can INTERFACE      such as vcan0; it may come and go while the program runs\n"
         "  --epos NODES         node ids of drives as delivered\n"
         "  --serial LINK        symbolic link to the pseudo-terminal, made and removed by this program\n"
         "  --silverlode ADDRS   addresses of drives as delivered\n"
         "  --bus NAME           the drives on this bus of the configuration (default: the only one)\n"
         "  --clock-error-ppm    of each drive's crystal, or one value for all\n"
         "  --bitrate BIT/S      of the bus modelled on an interface without bit timing (default: of the\n"
         "                       configuration, else 1000000); an interface with bit timing must have it\n"
         "  --baud BIT/S         of the line (default: of the configuration, else 57600)\n"
         "  --samples FOLDER     writes what each drive demands at each sample of its latest motion to\n"
         "                       FOLDER/NAME, a line each: host time (ns), time of the drive (s), demand "
         "and\n"
         "                       actual position (counts), 1 while it interpolates\n"
         "Faults: a line on the standard input is TARGET COMMAND, and is answered by a line. TARGET is\n"
         "  a joint, node id or address:  power_cycle SECONDS, stall 0|1, silence 0|1, clock PPM;\n"
         "      EPOS2: emcy CODE; SilverLode: fault KIND\n"
         "  a CAN interface:  drop COUNT, drop_id ID COUNT, disconnect 0|1, bus_off SECONDS\n"
         "  a link:  unplug SECONDS, disconnect 0|1, lose_requests COUNT, lose_replies COUNT,\n"
         "      garble_requests COUNT, garble_replies COUNT, garbage TEXT\n"
         "Ends by SIGINT or SIGTERM with exit code 0; 2: wrong arguments or configuration.\n";
}

}  // namespace interpolated_motion::emulated_drives
