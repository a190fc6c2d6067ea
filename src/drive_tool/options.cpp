#include "options.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/command_line/option_set.h"
#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "interpolated_motion_driver/units/closest_name.h"

namespace interpolated_motion::drive_tool {
namespace {

using command_line::OptionSet;

/// A command: what it is called, what it takes, and which options it knows.
struct Command {
  const char* name;
  const char* arguments;  ///< behind PLACE, for its usage
  std::size_t least;      ///< words it takes behind PLACE
  std::size_t most;
  const char* meaning;
  void (*add_options)(OptionSet& set, Options& options);
};

constexpr const char* kNotes =
    "PLACE is a CAN interface (can0) or the path of a serial port (/dev/ttyUSB0).\n"
    "Exit code: 0 done, 1 something is wrong with the drives or the bus, 2 wrong arguments, 130 "
    "interrupted.\n";

void add_bus_options(OptionSet& set, Options& options) {
  set.add_whole_number({"baud", "BIT/S",
                        fmt::format("of a serial line, one of {} bit/s (default: 57600)",
                                    fmt::join(hardware::serial_rates(), ", "))},
                       {300, 250'000}, options.baud);
  set.add_number(
      {"timeout", "SECONDS",
       "a drive may take for an answer, 0.002..10 s (default: 0.25 on CAN, 0.025 on a serial line); longer "
       "where ADL delays replies"},
      {0.002, 10.0}, options.timeout);
}

void add_scan_options(OptionSet& set, Options& options) {
  add_bus_options(set, options);
  set.add_switch("beside-master",
                 "asks the nodes although another master is on the bus: transfers of both may fail",
                 options.beside_master);
}

void add_drive_options(OptionSet& set, Options& options) {
  set.add_whole_numbers({"node", "NODE", "node id of the drive on a CAN bus, 1..127"}, {1, 127},
                        options.nodes);
  set.add_whole_numbers({"address", "ADDRESS", "of the drive on a serial line, 1..254"}, {1, 254},
                        options.addresses);
  add_scan_options(set, options);
}

void add_named_drive_options(OptionSet& set, Options& options) {
  add_drive_options(set, options);
  set.add_text(
      {"eds", "FILE", "electronic data sheet of the drive (CiA 306): names, types, defaults, ranges"},
      options.eds);
}

void add_writing_options(OptionSet& set, Options& options) {
  add_named_drive_options(set, options);
  set.add_switch("yes", "does not ask before it writes: for scripts", options.yes);
}

void add_file_options(OptionSet& set, Options& options) {
  add_writing_options(set, options);
  set.add_switch(
      "replacement",
      "the drive takes the place of that of the file: vendor and product must be the same, but not serial "
      "number, firmware and address",
      options.replacement);
}

void add_monitor_options(OptionSet& set, Options& options) {
  add_drive_options(set, options);
  set.add_switch("once", "one look, then it ends", options.once);
  set.add_number({"period", "SECONDS", "between two looks, 0.1..60 s (default: 0.5)"}, {0.1, 60},
                 options.period);
}

constexpr std::size_t kMany = 100;

constexpr Command kCommands[] = {
    {"scan", "", 0, 0,
     "Tells who is on a CAN bus or a serial line: drive, serial number, firmware, modes, whether the driver "
     "can\n"
     "use it and if not why. It only reads.\n",
     add_scan_options},
    {"read", " OBJECT...", 1, kMany,
     "Shows values: objects by number (0x6064, 0x1018:4) or by their name in an EDS, registers by number or "
     "name.\n",
     add_named_drive_options},
    {"write", " OBJECT VALUE", 2, 2, "Shows the old and the new value, asks, and writes.\n",
     add_writing_options},
    {"save", "", 0, 0, "Lets a drive keep its parameters without power (0x1010).\n", add_writing_options},
    {"dump", " FILE", 1, 1,
     "Writes all parameters of a drive to a text file; on CAN the EDS says which there are.\n",
     add_named_drive_options},
    {"diff", " FILE", 1, 1, "Shows in which parameters a drive differs from a file of dump.\n",
     add_file_options},
    {"restore", " FILE", 1, 1,
     "Shows in which parameters a drive differs from its file, asks, and writes them.\n", add_file_options},
    {"monitor", "", 0, 0,
     "Shows what drives do: position, state, buffer, current, errors, load of the bus.\n",
     add_monitor_options},
};

const Command* find_command(const std::string& name) {
  const auto* found = std::find_if(std::begin(kCommands), std::end(kCommands),
                                   [&name](const Command& command) { return name == command.name; });
  return found != std::end(kCommands) ? found : nullptr;
}

std::string synopsis(const Command& command) {
  return fmt::format("drive_tool {} PLACE{} [OPTIONS]\n{}", command.name, command.arguments, command.meaning);
}

OptionSet option_set(const Command& command, Options& options) {
  OptionSet set(synopsis(command), kNotes);
  set.add_arguments(options.words);
  command.add_options(set, options);
  return set;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  return names;
}

bool asks_for_help(const std::string& word) { return word == "--help" || word == "-h"; }

[[noreturn]] void refuse_command(const std::string& name) {
  const std::string closest = closest_name(name, command_names());
  throw std::invalid_argument(fmt::format("\"{}\" is no command; {}", name,
                                          closest.empty()
                                              ? fmt::format("there are {}", fmt::join(command_names(), ", "))
                                              : fmt::format("did you mean {}?", closest)));
}

void take_place(const Command& command, Options& options) {
  if (options.words.empty()) {
    throw std::invalid_argument(fmt::format(
        "say where: drive_tool {} PLACE, such as can0 or /dev/ttyUSB0; --help tells more", command.name));
  }
  options.place = options.words.front();
  options.words.erase(options.words.begin());
}

void check(const Command& command, const Options& options) {
  const auto rates = hardware::serial_rates();
  if (std::find(rates.begin(), rates.end(), static_cast<std::uint32_t>(options.baud)) == rates.end()) {
    throw std::invalid_argument(
        fmt::format("--baud is {}; allowed: {}", options.baud, fmt::join(rates, ", ")));
  }
  const std::size_t count = options.words.size();
  if (count >= command.least && count <= command.most) return;
  if (count > command.most && command.most == 0)
    throw std::invalid_argument(fmt::format("unknown argument {}", options.words.front()));
  throw std::invalid_argument(fmt::format("drive_tool {} PLACE{}: {} {} given", command.name,
                                          command.arguments, count, count == 1 ? "word is" : "words are"));
}

}  // namespace

std::optional<Options> parse_options(const std::vector<std::string>& arguments) {
  if (arguments.empty())
    throw std::invalid_argument(fmt::format("say what to do: {}", fmt::join(command_names(), ", ")));
  if (asks_for_help(arguments.front())) return std::nullopt;
  const Command* command = find_command(arguments.front());
  if (command == nullptr) refuse_command(arguments.front());
  Options options;
  options.command = command->name;
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (!option_set(*command, options).parse(rest)) return std::nullopt;
  take_place(*command, options);
  check(*command, options);
  return options;
}

std::string usage(const std::string& name) {
  Options options;
  if (const Command* command = find_command(name)) return option_set(*command, options).help();
  std::string text =
      "drive_tool COMMAND PLACE [ARGUMENTS] [OPTIONS]\nSees and sets the drives of a bus, without ROS.\n";
  for (const Command& command : kCommands) text += "\n" + synopsis(command);
  return text + "\ndrive_tool COMMAND --help lists the options of a command.\n" + kNotes;
}

}  // namespace interpolated_motion::drive_tool
