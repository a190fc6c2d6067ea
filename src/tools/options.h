#pragma once

#include <string>
#include <vector>

namespace interpolated_motion::tools {

/// Command line of trajectory_client.
struct Options {
  std::string goal_file;
  std::string node = "/driver";
  double timeout = 0.0;  ///< s for the whole run; 0: no limit once the server is there
  bool help = false;
};

/// Reads the arguments after the program's name. Throws std::runtime_error with the argument that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// How to call the program.
std::string usage();

}  // namespace interpolated_motion::tools
