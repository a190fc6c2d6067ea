#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "interpolated_motion_driver/node/clock.h"
#include "interpolated_motion_driver/node/planner_thread.h"
#include "interpolated_motion_driver/node/turn_time.h"

namespace interpolated_motion::node {

/// The one thread that owns the MotionHardware: it calls update() whenever that is due and runs what others
/// post to it. Others see copies of snapshots. The thread itself waits for nobody; goals are planned on
/// another one.
class HardwareThread {
 public:
  using Hardware = hardware::MotionHardware;

  /// Who is told what, on the thread itself: the functions must hand the matter on without waiting.
  struct Listener {
    std::function<void(const hardware::GoalAnswer&)> goal_answered;  ///< once for each goal handed in
    std::function<void(const motion::GoalResult&)> goal_ended;       ///< once for each goal that was accepted
    std::function<void(const Hardware::LogEntry&)> log;              ///< in the order in which they arose
    std::function<void(const std::string& error)> failed;            ///< an exception has ended the thread
  };

  struct Settings {
    HostDuration loop_period = std::chrono::milliseconds(20);  ///< longest sleep
    int realtime_priority = 0;                                 ///< SCHED_FIFO, 0: off
  };

  /// Makes the hardware that is to wait in the loop given, on the caller's thread.
  using Factory = std::function<std::unique_ptr<Hardware>(const hardware::EventLoop& loop)>;

  /// Calls `make` and starts the thread. Throws what `make` throws.
  HardwareThread(const Factory& make, const Settings& settings, Listener listener);
  /// Ends the thread at once; shut_down() is the polite way.
  ~HardwareThread();
  HardwareThread(const HardwareThread&) = delete;
  HardwareThread& operator=(const HardwareThread&) = delete;

  /// Runs `function(hardware, now)` on the thread and returns what it returns; empty when the thread has
  /// ended.
  template <class Function>
  auto call(Function function) -> std::optional<std::invoke_result_t<Function, Hardware&, HostTime>>;

  /// Runs `function(hardware, now)` on the thread, without waiting for it.
  void post(std::function<void(Hardware&, HostTime)> function);

  /// Starts a request on the thread and waits until it has ended. Without success when that takes longer than
  /// `patience`.
  motion::RequestResult request(std::function<motion::RequestId(Hardware&, HostTime)> start,
                                HostDuration patience);

  /// Hands in a goal, which is planned on a thread of its own; the listener is told the answer. Empty when
  /// the thread has ended.
  std::optional<hardware::Ticket> submit(trajectory::Goal goal);

  /// Copies the latest snapshot. `out` is reused, so that nothing is allocated once it has grown.
  void snapshot(motion::Snapshot& out) const;

  /// The longest that the thread was busy at a stretch, in the last minute or two: so long a halt may have to
  /// wait.
  HostDuration longest_turn() const { return turns_.longest(); }

  /// Brings the group to rest, switches the power stages off, and ends the thread. Waits no longer than about
  /// `patience`.
  void shut_down(HostDuration patience);

 private:
  using PromisedResult = std::shared_ptr<std::promise<motion::RequestResult>>;

  template <class Value>
  std::optional<Value> wait(std::future<Value> future, HostTime until) const;
  void planned(const motion::PlanningPtr& planning, HostDuration taken);
  void run();
  void apply_priority();
  void wake();
  void tick();
  void hand_out_events();
  void hand_out_snapshot();
  void schedule();
  void schedule_at(HostTime time);
  void stop();

  const Settings settings_;
  const Listener listener_;

  boost::asio::io_context io_;
  boost::asio::steady_timer timer_{io_};
  std::unique_ptr<Hardware> hardware_;
  HostTime last_tick_{};
  std::map<motion::RequestId, PromisedResult> requests_;

  motion::Snapshot back_;  ///< the thread's own, exchanged with front_
  TurnTime turns_;
  mutable std::mutex front_mutex_;
  motion::Snapshot front_;

  std::atomic<bool> ended_{false};
  std::thread thread_;
  PlannerThread planner_;
};

template <class Function>
auto HardwareThread::call(Function function)
    -> std::optional<std::invoke_result_t<Function, Hardware&, HostTime>> {
  using Value = std::invoke_result_t<Function, Hardware&, HostTime>;
  auto promise = std::make_shared<std::promise<Value>>();
  auto future = promise->get_future();
  post([promise, function = std::move(function)](Hardware& hardware, HostTime now) mutable {
    promise->set_value(function(hardware, now));
  });
  return wait(std::move(future), kNever);
}

template <class Value>
std::optional<Value> HardwareThread::wait(std::future<Value> future, HostTime until) const {
  // A thread that ends while the promise is still queued never keeps it: hence the look at ended_.
  constexpr auto kGlance = std::chrono::milliseconds(20);
  while (future.wait_for(kGlance) != std::future_status::ready) {
    if (ended_ || host_now() > until) return std::nullopt;
  }
  try {
    return future.get();
  } catch (const std::future_error&) {
    return std::nullopt;
  }
}

}  // namespace interpolated_motion::node
