#include "interpolated_motion_driver/node/action_server.h"

#include <string>

#include <ros/console.h>

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {
namespace {

Refusal shutting_down() { return {GoalError::InvalidGoal, "The driver is shutting down."}; }

/// Its client has cancelled a goal that was neither accepted nor rejected.
template <class Handle>
bool is_cancelled(const Handle& handle) {
  return handle.getGoalStatus().status == actionlib_msgs::GoalStatus::RECALLING;
}

}  // namespace

TrajectoryActionServer::TrajectoryActionServer(const ros::NodeHandle& node, HardwareThread& hardware)
    : hardware_(hardware),
      node_(node),
      server_(
          node_, "follow_joint_trajectory", [this](const Handle& handle) { on_goal(handle); },
          [this](const Handle& handle) { on_cancel(handle); }, false) {}

void TrajectoryActionServer::start() { server_.start(); }

void TrajectoryActionServer::on_goal(Handle handle) {
  const auto ticket = hardware_.submit(to_goal(*handle.getGoal()));
  // Its answer cannot have been handled yet: that is done by this same thread.
  if (ticket) handed_in_.emplace(*ticket, handle);
  if (!ticket) reject(handle, shutting_down());
}

void TrajectoryActionServer::reject_unanswered() {
  for (auto& [ticket, handle] : handed_in_) reject(handle, shutting_down());
  handed_in_.clear();
}

void TrajectoryActionServer::goal_answered(const hardware::GoalAnswer& answer) {
  const auto found = handed_in_.find(answer.ticket);
  if (found == handed_in_.end()) return;
  Handle handle = found->second;
  handed_in_.erase(found);
  if (!answer.answer) return reject(handle, answer.answer.error());
  const motion::GoalAcceptance& acceptance = answer.answer.value();
  for (const std::string& warning : acceptance.warnings) ROS_WARN_STREAM(warning);
  goals_.emplace(acceptance.id, handle);
  const bool cancelled = is_cancelled(handle);
  handle.setAccepted();
  if (cancelled) on_cancel(handle);  // too late to be withdrawn
}

void TrajectoryActionServer::reject(Handle& handle, const Refusal& refusal) {
  if (is_cancelled(handle)) return handle.setCanceled(to_result(refusal.code, refusal.text), refusal.text);
  if (const auto line = rejected_.pass("goal rejected: " + refusal.text, host_now())) ROS_ERROR_STREAM(*line);
  handle.setRejected(to_result(refusal.code, refusal.text), refusal.text);
}

void TrajectoryActionServer::on_cancel(const Handle& handle) {
  for (const auto& [ticket, known] : handed_in_) {
    if (!(known == handle)) continue;
    hardware_.post([wanted = ticket](HardwareThread::Hardware& hardware, HostTime now) {
      hardware.withdraw(wanted, now);
    });
    return;
  }
  for (const auto& [id, known] : goals_) {
    if (!(known == handle)) continue;
    hardware_.post(
        [goal = id](HardwareThread::Hardware& hardware, HostTime now) { hardware.cancel(goal, now); });
    return;
  }
}

void TrajectoryActionServer::goal_ended(const motion::GoalResult& result) {
  const auto found = goals_.find(result.id);
  if (found == goals_.end()) return;
  Handle handle = found->second;
  goals_.erase(found);
  switch (result.outcome) {
    case motion::GoalOutcome::Succeeded:
      handle.setSucceeded(to_result(result), result.text);
      return;
    case motion::GoalOutcome::Preempted:
      handle.setCanceled(to_result(result), result.text);
      return;
    case motion::GoalOutcome::Aborted:
      if (const auto line = aborted_.pass("goal aborted: " + result.text, host_now()))
        ROS_ERROR_STREAM(*line);
      handle.setAborted(to_result(result), result.text);
      return;
  }
}

void TrajectoryActionServer::publish_feedback() {
  if (goals_.empty()) return;
  hardware_.snapshot(snapshot_);
  const auto active = goals_.find(snapshot_.active_goal);
  if (active == goals_.end()) return;
  fill_state(snapshot_, feedback_);
  active->second.publishFeedback(feedback_);
}

}  // namespace interpolated_motion::node
