#include "options.h"

#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::tools {
namespace {

double read_number(const std::string& name, const std::string& text, double least, double most) {
  std::size_t read = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != text.size() || !(value >= least && value <= most)) {
    throw std::runtime_error(fmt::format("{} {}: give a number from {} to {}", name, text, least, most));
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
    if (name != "--goal" && name != "--setpoints" && name != "--lost" && name != "--node" &&
        name != "--timeout") {
      throw std::runtime_error(fmt::format("unknown argument {}", name));
    }
    if (++i == arguments.size()) throw std::runtime_error(name + " needs a value");
    if (name == "--goal") options.goal_file = arguments[i];
    if (name == "--node") options.node = arguments[i];
    if (name == "--setpoints") options.setpoints = read_number(name, arguments[i], 0.1, 3600.0);
    if (name == "--lost") options.lost = read_number(name, arguments[i], 0.0, 0.9);
    if (name == "--timeout") options.timeout = read_number(name, arguments[i], 0.001, 1e6);
  }
  if (options.goal_file.empty() == (options.setpoints == 0.0))
    throw std::runtime_error("give either --goal FILE or --setpoints SECONDS");
  return options;
}

std::string usage() {
  return "trajectory_client --goal FILE | --setpoints SECONDS [--lost PART] [--node NAME] [--timeout "
         "SECONDS]\n"
         "Sends a trajectory, or a stream of setpoints, to the driver, shows its progress and reports what "
         "the "
         "drives made of it.\n"
         "  --goal FILE        YAML trajectory_msgs/JointTrajectory\n"
         "  --setpoints SECONDS  a sine of all joints, 50 setpoints a second, each up to half a period late\n"
         "  --lost PART        of the setpoints is not sent, 0..0.9 (default 0)\n"
         "  --node NAME        the driver's node (default /driver)\n"
         "  --timeout SECONDS  for the whole run (default: 60 s for the driver to be ready, then the goal's "
         "own length + 60 s)\n"
         "Exit code: 0 SUCCEEDED, 2 bad file or arguments, 3 rejected, 4 aborted or preempted, 5 no answer "
         "in time.\n";
}

}  // namespace interpolated_motion::tools
