#include "options.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::tools {
namespace {

double read_seconds(const std::string& text) {
  std::size_t read = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != text.size() || !(value > 0.0) || !std::isfinite(value)) {
    throw std::runtime_error(fmt::format("--timeout {}: give a number of seconds above 0", text));
  }
  return value;
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    if (name == "--help" || name == "-h") {
      options.help = true;
      return options;
    }
    if (name != "--goal" && name != "--node" && name != "--timeout") {
      throw std::runtime_error(fmt::format("unknown argument {}", name));
    }
    if (++i == arguments.size()) throw std::runtime_error(name + " needs a value");
    if (name == "--goal") options.goal_file = arguments[i];
    if (name == "--node") options.node = arguments[i];
    if (name == "--timeout") options.timeout = read_seconds(arguments[i]);
  }
  if (options.goal_file.empty()) throw std::runtime_error("--goal FILE is missing");
  return options;
}

std::string usage() {
  return "trajectory_client --goal FILE [--node NAME] [--timeout SECONDS]\n"
         "Sends a trajectory to the driver, shows its progress and reports what the drives made of it.\n"
         "  --goal FILE        YAML trajectory_msgs/JointTrajectory\n"
         "  --node NAME        the driver's node (default /driver)\n"
         "  --timeout SECONDS  for the whole run (default: 60 s for the driver to be ready, then the goal's "
         "own length + 60 s)\n"
         "Exit code: 0 SUCCEEDED, 2 bad file or arguments, 3 rejected, 4 aborted or preempted, 5 no answer "
         "in time.\n";
}

}  // namespace interpolated_motion::tools
