#pragma once

#include <string>

#include <ros/ros.h>

namespace interpolated_motion::tools {

/// A stream of setpoints as a bad network delivers it: a sine of all joints around where they stand, 50
/// setpoints a second, each up to half a period late, a part of them lost.
struct StreamOptions {
  std::string node;       ///< the driver's
  double duration = 0.0;  ///< s
  double lost = 0.0;      ///< 0..1
};

/// Sends the stream and waits for the arm's rest. True when every joint rests where the last setpoint has led
/// it; what happens, and why not, is printed.
bool stream_setpoints(ros::NodeHandle& ros_node, const StreamOptions& options);

}  // namespace interpolated_motion::tools
