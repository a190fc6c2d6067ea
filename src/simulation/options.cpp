#include "simulation/options.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "simulation/arm_generator.h"

namespace interpolated_motion::simulation {

namespace {

std::uint64_t whole_number(const std::string& name, const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 19 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!digits) throw std::invalid_argument(fmt::format("{} {}: give a whole number", name, text));
  return std::stoull(text);
}

std::string kind(const std::string& text) {
  const auto& kinds = arm_kinds();
  if (std::find(kinds.begin(), kinds.end(), text) != kinds.end()) return text;
  throw std::invalid_argument(fmt::format("--config {}: known are {}", text, fmt::join(kinds, ", ")));
}

/// True where `name` is a switch.
bool read_switch(const std::string& name, Options& options) {
  if (name == "--no-shrink") return !(options.shrink = false);
  if (name == "--known") return options.tell_known = true;
  if (name == "--each") return options.each = true;
  return false;
}

void read_value(const std::string& name, const std::string& value, Options& options) {
  if (name == "--seeds") {
    options.seeds = whole_number(name, value);
  } else if (name == "--start") {
    options.start = whole_number(name, value);
  } else if (name == "--config") {
    options.kind = kind(value);
  } else if (name == "--replay") {
    options.replay = true;
    options.start = whole_number(name, value);
    options.seeds = 1;
  } else if (name == "--script") {
    options.replay = true;
    options.script_file = value;
  } else {
    throw std::invalid_argument(fmt::format("unknown argument {}", name));
  }
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--help" || arguments[i] == "-h") {
      options.help = true;
      return options;
    }
    if (read_switch(arguments[i], options)) continue;
    if (i + 1 == arguments.size()) throw std::invalid_argument(arguments[i] + " is unknown or needs a value");
    read_value(arguments[i], arguments[i + 1], options);
    ++i;
  }
  return options;
}

std::string usage() {
  return "simulate [--seeds N] [--start S] [--config KIND] [--no-shrink] | --replay SEED [--config KIND] | "
         "--script FILE\n"
         "Runs the whole driver with emulated drives in virtual time through random histories, one for each "
         "seed.\n"
         "  --seeds N      so many of them (default 100), from seed S of --start S (default 1) on\n"
         "  --config KIND  of arm: epos, silverlode, cyclic, mixed, all, random (default: the seed decides)\n"
         "  --no-shrink    scripts of failures are printed as they are\n"
         "  --known        the smallest script of each known fault too\n"
         "  --replay SEED  one seed, told event by event\n"
         "  --script FILE  the same of a script as a failure prints it\n"
         "  --each         tells of each seed, for scripts/simulate\n"
         "Exit code 0: all have passed, but for known faults; 1: some have failed; 2: wrong arguments.\n";
}

}  // namespace interpolated_motion::simulation
