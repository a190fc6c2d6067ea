#include "simulation/options.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/option_set.h"
#include "simulation/arm_generator.h"

namespace interpolated_motion::simulation {

namespace {

constexpr const char* kSynopsis =
    "simulate [--seeds N] [--start S] [--config KIND] [--no-shrink]\n"
    "simulate --replay SEED [--config KIND]\n"
    "simulate --script FILE\n"
    "simulate --recording FILE\n"
    "simulate --fail-each frame|allocation [--config KIND] [--start N] [--stride N]\n"
    "Runs the whole driver with emulated drives in virtual time through random histories, one for each "
    "seed.\n";

constexpr const char* kNotes =
    "Exit code 0: all have passed, but for known faults; 1: some have failed; 2: wrong arguments.\n";

constexpr command_line::Range kStride{1, 1'000'000};
constexpr command_line::Range kSeeds{0, std::numeric_limits<int>::max()};

/// Options as they are given, where that is not as they are meant.
struct Given {
  int start = 1;
  int seeds = 100;
  int replay = -1;
  int stride = 1;
  bool no_shrink = false;
};

command_line::OptionSet option_set(Given& given, Options& options) {
  command_line::OptionSet set(kSynopsis, kNotes);
  set.add_whole_number({"seeds", "N", "so many histories (default: 100)"}, kSeeds, given.seeds);
  set.add_whole_number({"start", "S", "the first seed (default: 1)"}, kSeeds, given.start);
  set.add_text(
      {"config", "KIND", fmt::format("of arm: {} (default: the seed decides)", fmt::join(arm_kinds(), ", "))},
      options.kind);
  set.add_switch("no-shrink", "scripts of failures are printed as they are", given.no_shrink);
  set.add_switch("known", "the smallest script of each known fault too", options.tell_known);
  set.add_whole_number({"replay", "SEED", "one seed, told event by event"}, kSeeds, given.replay);
  set.add_text({"script", "FILE", "the same of a script as a failure prints it"}, options.script_file);
  set.add_text({"recording", "FILE", "orders and faults of a flight recorder's recording, carried out again"},
               options.recording_file);
  set.add_text({"fail-each", "WHAT",
                "whole runs of each kind of arm (epos, cyclic, silverlode, mixed), in each of which the next "
                "frame (a text on a serial line) or allocation of the driver fails: frame, allocation"},
               options.fail_each);
  set.add_whole_number({"stride", "N", "with --fail-each: every N-th of them (default: 1)"}, kStride,
                       given.stride);
  set.add_text({"recordings", "FOLDER", "for recordings of failures, 20 at most (default: none are written)"},
               options.recordings);
  set.add_switch("each", "tells of each seed, for scripts/simulate", options.each);
  return set;
}

void check_fail_each(const std::string& what) {
  if (what.empty() || what == "frame" || what == "allocation") return;
  throw std::invalid_argument(fmt::format("--fail-each {}: allowed: frame, allocation", what));
}

void check_kind(const std::string& kind) {
  const auto& kinds = arm_kinds();
  if (kind.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  throw std::invalid_argument(fmt::format("--config {}: known are {}", kind, fmt::join(kinds, ", ")));
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  Given given;
  Options options;
  options.help = !option_set(given, options).parse(arguments);
  check_kind(options.kind);
  check_fail_each(options.fail_each);
  options.stride = static_cast<std::uint64_t>(given.stride);
  options.shrink = !given.no_shrink;
  options.replay = given.replay >= 0 || !options.script_file.empty();
  options.start = static_cast<std::uint64_t>(given.replay >= 0 ? given.replay : given.start);
  options.seeds = options.replay ? 1 : static_cast<std::uint64_t>(given.seeds);
  return options;
}

std::string usage() {
  Given given;
  Options options;
  return option_set(given, options).help();
}

}  // namespace interpolated_motion::simulation
