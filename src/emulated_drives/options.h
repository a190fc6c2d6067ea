#pragma once

#include <optional>
#include <string>
#include <vector>

namespace interpolated_motion::emulated_drives {

/// Command line of emulated_drives.
struct Options {
  std::string interface;       ///< SocketCAN interface; empty: none, or those of the configuration
  std::vector<int> nodes;      ///< node ids of EPOS drives with default settings, 1..127
  std::string link;            ///< link to a pseudo-terminal; empty: none, or those of the configuration
  std::vector<int> addresses;  ///< addresses of SilverLode drives with default settings, 1..254
  std::string config_file;     ///< driver configuration whose drives are emulated
  std::string bus;             ///< the bus of that configuration; empty: its only one of that type
  std::vector<double> clock_errors;  ///< ppm, one for each drive or one for all; empty: as configured
  int bitrate = 0;                   ///< bit/s, 0: of the configuration, else 1000000
  int baud = 0;                      ///< bit/s, 0: of the configuration, else 57600
  std::string samples_folder;        ///< where each drive's latest motion is written; empty: nowhere
};

/// Reads the arguments after the program's name; nothing when they ask for help. Throws std::invalid_argument
/// with the argument that is wrong and what is allowed.
std::optional<Options> parse_options(const std::vector<std::string>& arguments);

/// How to call the program: every option, its unit and default.
std::string usage();

}  // namespace interpolated_motion::emulated_drives
