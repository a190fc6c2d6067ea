#include "options.h"

#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/option_set.h"

namespace interpolated_motion::tools {
namespace {

constexpr const char* kSynopsis =
    "trajectory_client --goal FILE | --setpoints SECONDS [--lost PART] [--node NAME] [--wait SECONDS]\n"
    "                  [--timeout SECONDS] [NAME:=VALUE ...]\n"
    "Sends a trajectory, or a stream of setpoints, to the driver, shows its progress and reports what the\n"
    "drives made of it.\n";

constexpr const char* kNotes =
    "NAME:=VALUE, __name:=VALUE and the like are ROS's.\n"
    "Exit code: 0 SUCCEEDED, 2 bad file or arguments, 3 rejected, 4 aborted or preempted, 5 no answer in "
    "time.\n";

command_line::OptionSet option_set(Options& options) {
  command_line::OptionSet set(kSynopsis, kNotes);
  set.add_text({"goal", "FILE", "YAML trajectory_msgs/JointTrajectory"}, options.goal_file);
  set.add_number(
      {"setpoints", "SECONDS",
       "streams a sine of all joints for 0.1..3600 s instead: 50 setpoints a second, each up to half "
       "a period late"},
      {0.1, 3600.0}, options.setpoints);
  set.add_number({"lost", "PART", "of the setpoints is not sent, 0..0.9 (default: 0)"}, {0.0, 0.9},
                 options.lost);
  set.add_text({"node", "NAME", fmt::format("the driver's node (default: {})", options.node)}, options.node);
  set.add_number({"wait", "SECONDS",
                  "for ROS's master and a driver that is still to be started, 0..1e6 s (default: 0, both "
                  "must be there)"},
                 {0.0, 1e6}, options.wait);
  set.add_number({"timeout", "SECONDS",
                  "for the whole run, 0.001..1e6 s (default: the goal's own length + 60 s once the driver is "
                  "ready)"},
                 {0.001, 1e6}, options.timeout);
  return set;
}

}  // namespace

std::optional<Options> parse_options(const std::vector<std::string>& arguments) {
  Options options;
  if (!option_set(options).parse(arguments)) return std::nullopt;
  if (options.goal_file.empty() == (options.setpoints == 0.0))
    throw std::invalid_argument("give either --goal FILE or --setpoints SECONDS");
  return options;
}

std::string usage() {
  Options options;
  return option_set(options).help();
}

}  // namespace interpolated_motion::tools
