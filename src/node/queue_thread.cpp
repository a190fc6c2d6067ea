#include "interpolated_motion_driver/node/queue_thread.h"

#include <algorithm>

#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {
namespace {

/// Longest wait: whoever serves a queue looks that often whether to stop.
constexpr HostDuration kGlance = std::chrono::milliseconds(100);

}  // namespace

void serve_once(ros::CallbackQueue& queue, PeriodicCalls& calls) {
  const HostDuration to_deadline = std::max(calls.next_deadline() - host_now(), HostDuration(0));
  queue.callAvailable(ros::WallDuration(seconds(std::min(to_deadline, kGlance))));
  calls.poll(host_now());
}

void QueueThread::start() {
  thread_ = std::thread([this] { run(); });
}

void QueueThread::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void QueueThread::run() {
  while (!stopping_) serve_once(queue_, calls_);
}

}  // namespace interpolated_motion::node
