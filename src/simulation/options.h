#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace interpolated_motion::simulation {

/// Command line of simulate.
struct Options {
  std::uint64_t start = 1;     ///< first seed
  std::uint64_t seeds = 100;   ///< how many
  std::string kind;            ///< of arms, see arm_kinds(); empty: all
  bool replay = false;         ///< one seed or script, told event by event
  std::string script_file;     ///< a script instead of seeds
  std::string recording_file;  ///< a recording instead of seeds
  std::string recordings;      ///< folder for the recordings of failures; empty: they are not written
  std::string fail_each;       ///< frame, allocation: whole runs in which one after the other fails, no seeds
  std::uint64_t stride = 1;    ///< of these
  bool shrink = true;          ///< the scripts of failures
  bool tell_known = false;     ///< scripts of known faults too
  bool each = false;           ///< tells of every seed before it is run and after, for scripts/simulate
  bool help = false;
};

/// Reads the arguments after the program's name. Throws std::invalid_argument with the argument that is
/// wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// How to call the program.
std::string usage();

}  // namespace interpolated_motion::simulation
