#include <csignal>
#include <exception>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "interpolated_motion_driver/node/driver_node.h"
#include "interpolated_motion_driver/node/load_configuration.h"

namespace {

volatile std::sig_atomic_t stop_requested = 0;

void request_stop(int /*signal*/) { stop_requested = 1; }

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

}  // namespace

int main(int argc, char** argv) {
  // The drives are to be stopped before ROS is, so its own signal handler must not act first.
  ros::init(argc, argv, "driver", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  // With the last node handle ROS ends, and its log with it: this one outlives the message why the driver
  // ends.
  const ros::NodeHandle node("~");
  const int exit_code = run(node);
  ros::shutdown();
  return exit_code;
}
