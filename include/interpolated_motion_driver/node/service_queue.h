#pragma once

#include <ros/callback_queue.h>
#include <ros/spinner.h>

namespace interpolated_motion::node {

/// A queue of calls of services, and the threads that answer them and do nothing else.
class ServiceQueue {
 public:
  /// `threads`: calls that may be under way at a time.
  explicit ServiceQueue(unsigned threads) : spinner_(threads, &queue_) {}

  /// To be set at the node handles that advertise the services. Calls wait in it until start().
  ros::CallbackQueue& queue() { return queue_; }
  void start() { spinner_.start(); }
  /// Waits until the calls under way are answered; those that come later never are.
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace interpolated_motion::node
