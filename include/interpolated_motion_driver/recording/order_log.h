#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::recording {

/// What somebody has asked the driver for, and what it has answered; not a setpoint.
struct Order {
  HostTime time{};
  std::string verb;       ///< goal, cancel, enable, disable, shut_down, reset, halt, clear, inject, absence
  std::string arguments;  ///< in YAML, without braces around them; those of a goal without the goal itself
  std::shared_ptr<const trajectory::Goal> goal;  ///< only of a goal
  motion::GoalId id = 0;                         ///< of a goal that was accepted
  HostTime ended = kNever;                       ///< the goal

  std::size_t bytes() const;  ///< of memory, about
};

/// The orders of the last seconds, and those before that were still in force then: from the oldest goal under
/// way on, however old that is.
class OrderLog {
 public:
  /// `bytes`: of memory; when orders take more, the oldest are left out that are no goal under way.
  explicit OrderLog(std::size_t bytes) : capacity_(bytes) {}

  void add(Order order);
  /// The newest order, to be changed, or null.
  Order* newest() { return orders_.empty() ? nullptr : &orders_.back(); }
  /// The goal is no longer under way.
  void end(motion::GoalId goal, HostTime now);
  /// Forgets what ended before `time`, but not what came after an order that is kept.
  void forget_before(HostTime time);

  const std::deque<Order>& orders() const { return orders_; }
  std::size_t used() const { return used_; }  ///< bytes
  /// Orders no longer there because they were too old, and because there was no room.
  std::uint64_t forgotten() const { return forgotten_; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::size_t capacity_;
  std::size_t used_ = 0;
  std::uint64_t forgotten_ = 0;
  std::uint64_t left_out_ = 0;
  std::deque<Order> orders_;
};

}  // namespace interpolated_motion::recording
