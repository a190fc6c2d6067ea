#include "interpolated_motion_driver/recording/order_log.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::recording {

namespace {

bool is_under_way(const Order& order) { return order.id != 0 && order.ended == kNever; }

std::size_t bytes_of(const trajectory::Waypoint& point) {
  const std::size_t numbers =
      point.positions.size() + point.velocities.size() + point.accelerations.size() + point.efforts.size();
  return sizeof point + numbers * sizeof(double);
}

std::size_t bytes_of(const trajectory::Goal& goal) {
  std::size_t bytes = sizeof goal;
  for (const trajectory::Waypoint& point : goal.points) bytes += bytes_of(point);
  for (const std::string& name : goal.joint_names) bytes += sizeof(std::string) + name.size();
  return bytes +
         (goal.path_tolerance.size() + goal.goal_tolerance.size()) * sizeof(trajectory::JointTolerance);
}

}  // namespace

std::size_t Order::bytes() const {
  return sizeof *this + verb.size() + arguments.size() + (goal ? bytes_of(*goal) : 0);
}

void OrderLog::add(Order order) {
  used_ += order.bytes();
  orders_.push_back(std::move(order));
  while (used_ > capacity_) {
    const auto oldest = std::find_if_not(orders_.begin(), orders_.end(), is_under_way);
    if (oldest == orders_.end()) return;
    used_ -= oldest->bytes();
    orders_.erase(oldest);
    ++left_out_;
  }
}

void OrderLog::end(motion::GoalId goal, HostTime now) {
  for (Order& order : orders_) {
    if (order.id == goal && order.ended == kNever) order.ended = now;
  }
}

void OrderLog::forget_before(HostTime time) {
  const auto is_over = [time](const Order& order) {
    return order.time < time && !is_under_way(order) && (order.id == 0 || order.ended < time);
  };
  for (; !orders_.empty() && is_over(orders_.front()); ++forgotten_) {
    used_ -= orders_.front().bytes();
    orders_.pop_front();
  }
}

}  // namespace interpolated_motion::recording
