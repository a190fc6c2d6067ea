#pragma once

#include <optional>
#include <string>
#include <vector>

namespace interpolated_motion::drive_tool {

/// What the user asks for.
struct Options {
  std::string command;             ///< "scan", ...
  std::string place;               ///< a CAN interface, or the path of a serial port
  std::vector<std::string> words;  ///< what the command takes besides: objects, values, a file
  std::vector<int> nodes;          ///< 1..127
  std::vector<int> addresses;      ///< 1..254
  std::string eds;                 ///< file; may be empty
  bool yes = false;                ///< what would be asked is agreed to
  bool replacement = false;        ///< the drive is another one than that of the file
  bool once = false;               ///< one look
  double period = 0.5;             ///< s, between two looks
  int baud = 57'600;               ///< bit/s
  std::optional<double> timeout;   ///< s, for each answer of a drive; nothing: as the bus has it
  bool beside_master = false;      ///< ask although another master is on the bus

  /// Whether `place` is a serial port: CAN interfaces have no path.
  bool serial() const { return place.find('/') != std::string::npos; }
};

/// Nothing when help was asked for. Throws std::invalid_argument naming the argument and what is allowed.
std::optional<Options> parse_options(const std::vector<std::string>& arguments);

/// For the terminal: what each command takes and does. Of all commands where `command` is none of them.
std::string usage(const std::string& command);

}  // namespace interpolated_motion::drive_tool
