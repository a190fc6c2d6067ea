#pragma once

#include <atomic>
#include <thread>

#include <ros/callback_queue.h>

#include "interpolated_motion_driver/node/periodic_calls.h"

namespace interpolated_motion::node {

/// Waits until `queue` has something or one of `calls` is due, 0.1 s at most, and calls all that there is.
/// One such turn after the other is a thread that serves both.
void serve_once(ros::CallbackQueue& queue, PeriodicCalls& calls);

/// A thread that serves a queue and calls at fixed rates. One wake-up serves all that falls on one instant,
/// where ros::Timer takes three for each timer, in a thread of its own.
class QueueThread {
 public:
  /// What is referred to must live longer, and is the thread's alone from start() to stop(), but for
  /// additions to the queue.
  QueueThread(ros::CallbackQueue& queue, PeriodicCalls& calls) : queue_(queue), calls_(calls) {}
  ~QueueThread() { stop(); }
  QueueThread(const QueueThread&) = delete;
  QueueThread& operator=(const QueueThread&) = delete;

  /// Starts the thread; to be called once.
  void start();
  /// Ends the thread and waits for its end.
  void stop();

 private:
  void run();

  ros::CallbackQueue& queue_;
  PeriodicCalls& calls_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace interpolated_motion::node
