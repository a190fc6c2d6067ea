#include "options.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/command_line/option_set.h"
#include "interpolated_motion_driver/hardware/bus_configuration.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr const char* kSynopsis =
    "emulated_drives --config FILE\n"
    "emulated_drives --can INTERFACE  (--epos NODE[,NODE...] | --config FILE [--bus NAME])\n"
    "emulated_drives --serial LINK    (--silverlode ADDRESS[,ADDRESS...] | --config FILE [--bus NAME])\n"
    "Serves emulated maxon EPOS2 drives on a SocketCAN interface, for any CANopen master, and emulated\n"
    "QuickSilver SilverLode drives on a pseudo-terminal, for any program that opens it as a serial port.\n";

constexpr const char* kNotes =
    "Samples: a line for each sample of the latest motion: host time (ns), time of the drive (s), demand "
    "and\n"
    "  actual position (counts), 1 while it interpolates\n"
    "Faults: a line on the standard input is TARGET COMMAND, and is answered by a line. TARGET is\n"
    "  a joint, node id or address:  power_cycle SECONDS, stall 0|1, silence 0|1, clock PPM;\n"
    "      EPOS2: emcy CODE; SilverLode: fault KIND\n"
    "  a CAN interface:  drop COUNT, drop_id ID COUNT, disconnect 0|1, bus_off SECONDS, repeat_id ID COUNT, "
    "send FRAME\n"
    "  a link:  unplug SECONDS, disconnect 0|1, lose_requests COUNT, lose_replies COUNT,\n"
    "      garble_requests COUNT, garble_replies COUNT, garbage TEXT\n"
    "Ends by SIGINT or SIGTERM with exit code 0; 2: wrong arguments or configuration.\n";

constexpr command_line::Range kNodeIds{1, 127};
constexpr command_line::Range kAddresses{1, 254};
constexpr command_line::Range kClockErrors{-1e5, 1e5};  // ppm
constexpr command_line::Range kBitrates{10'000, 1'000'000};
constexpr command_line::Range kBauds{300, 250'000};

command_line::OptionSet option_set(Options& options) {
  command_line::OptionSet set(kSynopsis, kNotes);
  set.add_text(
      {"config", "FILE",
       "alone: all drives of a driver configuration whose buses have transport socketcan or serial, on "
       "their interfaces and devices"},
      options.config_file);
  set.add_text({"can", "INTERFACE", "such as vcan0; it may come and go while the program runs"},
               options.interface);
  set.add_whole_numbers({"epos", "NODES", "node ids of EPOS drives as delivered, 1..127"}, kNodeIds,
                        options.nodes);
  set.add_text({"serial", "LINK", "symbolic link to the pseudo-terminal, made and removed by this program"},
               options.link);
  set.add_whole_numbers({"silverlode", "ADDRESSES", "of SilverLode drives as delivered, 1..254"}, kAddresses,
                        options.addresses);
  set.add_text(
      {"bus", "NAME", "the drives on this bus of the configuration (default: the only one of its type)"},
      options.bus);
  set.add_numbers({"clock-error-ppm", "PPM",
                   "of each drive's crystal, or one value for all, -100000..100000 ppm (default: of the "
                   "configuration, else 0)"},
                  kClockErrors, options.clock_errors);
  set.add_whole_number(
      {"bitrate", "BIT/S",
       "of the bus modelled on an interface without bit timing, 10000..1000000 bit/s (default: "
       "of the configuration, else 1000000); an interface with bit timing must have it"},
      kBitrates, options.bitrate);
  set.add_whole_number(
      {"baud", "BIT/S", "of the line, 300..250000 bit/s (default: of the configuration, else 57600)"}, kBauds,
      options.baud);
  set.add_text({"samples", "FOLDER",
                "writes what each drive demands in its latest motion to FOLDER/NAME (default: nowhere)"},
               options.samples_folder);
  return set;
}

void check_drives(const Options& options, const std::string& place, const std::vector<int>& drives,
                  const char* example) {
  const bool from_file = !options.config_file.empty();
  if (!place.empty() && drives.empty() != from_file)
    throw std::invalid_argument(fmt::format("say which drives: either {} or --config FILE", example));
  if (place.empty() && !drives.empty())
    throw std::invalid_argument(fmt::format("{}: say where, by --can INTERFACE or --serial LINK", example));
}

void refuse_twice(const char* option, const std::vector<int>& numbers) {
  std::set<int> seen;
  for (const int number : numbers) {
    if (seen.insert(number).second) continue;
    throw std::invalid_argument(
        fmt::format("{} names {} twice; each drive needs a number of its own", option, number));
  }
}

void check_rate(const char* option, int rate, const std::vector<std::uint32_t>& allowed) {
  const bool is_allowed =
      std::find(allowed.begin(), allowed.end(), static_cast<std::uint32_t>(rate)) != allowed.end();
  if (rate == 0 || is_allowed) return;
  throw std::invalid_argument(fmt::format("{} is {}; allowed: {}", option, rate, fmt::join(allowed, ", ")));
}

void check(const Options& options) {
  refuse_twice("--epos", options.nodes);
  refuse_twice("--silverlode", options.addresses);
  check_rate("--baud", options.baud, hardware::serial_rates());
  check_rate("--bitrate", options.bitrate, hardware::can_rates());
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

std::optional<Options> parse_options(const std::vector<std::string>& arguments) {
  Options options;
  if (!option_set(options).parse(arguments)) return std::nullopt;
  check(options);
  return options;
}

std::string usage() {
  Options options;
  return option_set(options).help();
}

}  // namespace interpolated_motion::emulated_drives
