#pragma once

#include <functional>
#include <memory>

#include <boost/asio/thread_pool.hpp>

#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// Plans goals, one after the other, on a thread of its own, which leaves the processor to the bus thread
/// when both want it.
class PlannerThread {
 public:
  /// `done(planning, taken)` is called on that thread, `taken`: how long the planning took.
  using Done = std::function<void(const motion::PlanningPtr& planning, HostDuration taken)>;

  explicit PlannerThread(Done done);
  /// Waits for the planning that runs; others are forgotten.
  ~PlannerThread();
  PlannerThread(const PlannerThread&) = delete;
  PlannerThread& operator=(const PlannerThread&) = delete;

  /// A goal to be handed in. Whoever lets go of it last, it is freed on this thread: that takes its time with
  /// many points, too.
  motion::GoalPtr keep(trajectory::Goal goal) const;

  /// From any thread; returns at once. Planning that throws, for want of memory, refuses its goal.
  void plan(motion::PlanningPtr planning);

 private:
  const Done done_;
  const std::shared_ptr<boost::asio::thread_pool> pool_ = std::make_shared<boost::asio::thread_pool>(1);
};

}  // namespace interpolated_motion::node
