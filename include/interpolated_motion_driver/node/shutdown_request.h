#pragma once

#include <functional>

namespace interpolated_motion::node {

/// Has `stop` called when somebody ends the node by name (`rosnode kill`, a node of the same name), instead
/// of ROS ending at once: results can be sent only while ROS is there. `stop` is called by ROS's own thread.
/// To be called once, after the first ros::NodeHandle has been made.
void on_shutdown_request(std::function<void()> stop);

}  // namespace interpolated_motion::node
