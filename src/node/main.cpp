#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "interpolated_motion_driver/command_line/option_set.h"
#include "interpolated_motion_driver/node/driver_node.h"
#include "interpolated_motion_driver/node/load_configuration.h"
#include "interpolated_motion_driver/node/shutdown_request.h"

namespace {

constexpr int kBadArguments = 2;

constexpr const char* kSynopsis =
    "driver_node [NAME:=VALUE ...]\n"
    "Executes JointTrajectory goals on servo drives that interpolate by themselves. Its configuration are "
    "its\n"
    "private parameters on ROS's parameter server: roslaunch interpolated_motion_driver driver.launch\n"
    "config:=FILE loads a YAML file there and starts it. docs/configuration.md lists all parameters with "
    "unit,\n"
    "range and default, docs/ros_interface.md the action, topics and services.\n";

constexpr const char* kNotes =
    "Arguments of ROS:\n"
    "  __name:=NAME      name of the node, before its parameters, topics and services (default: driver)\n"
    "  __ns:=NAMESPACE   of the node (default: /)\n"
    "  FROM:=TO          another name for a topic or service\n"
    "  _PARAMETER:=VALUE sets a private parameter, such as _wire_log:=FILE\n"
    "Ends by SIGINT, SIGTERM or rosnode kill with the joints at rest and exit code 0; 1: wrong "
    "configuration, or\n"
    "a failure; 2: wrong arguments.\n";

/// Set by a signal, or on the thread that answers other nodes.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not wait for a lock");

void request_stop(int /*signal*/) { stop_requested = true; }

int run(const ros::NodeHandle& node) {
  using namespace interpolated_motion::node;
  try {
    DriverNode driver(load_configuration(node));
    return driver.run(stop_requested);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
}

/// The command line, but for what is ROS's. Nothing: go on; else the exit code to end with.
std::optional<int> answer_arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  arguments.erase(arguments.begin());
  const interpolated_motion::command_line::OptionSet options(kSynopsis, kNotes);
  try {
    if (options.parse(arguments)) return std::nullopt;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "driver_node: %s\n", error.what());
    return kBadArguments;
  }
  std::fputs(options.help().c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (const auto exit_code = answer_arguments(argc, argv)) return *exit_code;
  // The drives are to be stopped before ROS is, so its own signal handler must not act first.
  ros::init(argc, argv, "driver", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  // With the last node handle ROS ends, and its log with it: this one outlives the message why the driver
  // ends.
  const ros::NodeHandle node("~");
  interpolated_motion::node::on_shutdown_request([] { stop_requested = true; });
  const int exit_code = run(node);
  ros::shutdown();
  return exit_code;
}
