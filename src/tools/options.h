#pragma once

#include <optional>
#include <string>
#include <vector>

namespace interpolated_motion::tools {

/// Command line of trajectory_client.
struct Options {
  std::string goal_file;   ///< empty: none
  double setpoints = 0.0;  ///< s of a stream of setpoints, instead of a goal
  double lost = 0.0;       ///< part of the setpoints that never arrive, 0..0.9
  std::string node = "/driver";
  double wait = 0.0;     ///< s for ROS's master and the driver to be started; 0: they must be there
  double timeout = 0.0;  ///< s for the whole run; 0: none, the goal's own length and some more is its limit
};

/// Reads the arguments after the program's name; nothing when they ask for help. Throws std::invalid_argument
/// with the argument that is wrong and what is allowed.
std::optional<Options> parse_options(const std::vector<std::string>& arguments);

/// How to call the program: every option, its unit and default.
std::string usage();

}  // namespace interpolated_motion::tools
