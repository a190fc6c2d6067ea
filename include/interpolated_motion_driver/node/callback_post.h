#pragma once

#include <functional>

#include <ros/callback_queue_interface.h>

namespace interpolated_motion::node {

/// Has `function` called by whoever serves `queue`. Holds the queue's lock only for the insertion, so the bus
/// thread may use it.
void post_to(ros::CallbackQueueInterface& queue, std::function<void()> function);

}  // namespace interpolated_motion::node
