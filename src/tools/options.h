#pragma once

#include <string>
#include <vector>

namespace interpolated_motion::tools {

/// Command line of trajectory_client.
struct Options {
  std::string goal_file;
  double setpoints = 0.0;  ///< s of a stream of setpoints, instead of a goal
  double lost = 0.0;       ///< part of the setpoints that never arrive, 0..0.9
  std::string node = "/driver";
  double timeout = 0.0;  ///< s for the whole run; 0: no limit once the server is there
  bool help = false;
};

/// Reads the arguments after the program's name. Throws std::runtime_error with the argument that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// How to call the program.
std::string usage();

}  // namespace interpolated_motion::tools
