#include "interpolated_motion_driver/node/action_server.h"

#include <ros/console.h>

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {

TrajectoryActionServer::TrajectoryActionServer(const ros::NodeHandle& node, HardwareThread& hardware)
    : hardware_(hardware),
      node_(node),
      server_(
          node_, "follow_joint_trajectory", [this](const Handle& handle) { on_goal(handle); },
          [this](const Handle& handle) { on_cancel(handle); }, false) {}

void TrajectoryActionServer::start() { server_.start(); }

void TrajectoryActionServer::on_goal(Handle handle) {
  const auto answer = hardware_.call([goal = to_goal(*handle.getGoal())](auto& hardware, HostTime now) {
    return hardware.submit(goal, now);
  });
  if (!answer || !*answer) {
    const Refusal refusal =
        answer ? answer->error() : Refusal{GoalError::InvalidGoal, "The driver is shutting down."};
    const auto line = rejected_.pass("goal rejected: " + refusal.text, host_now());
    if (line) ROS_ERROR_STREAM(*line);
    handle.setRejected(to_result(refusal.code, refusal.text), refusal.text);
    return;
  }
  const motion::GoalAcceptance& acceptance = answer->value();
  for (const std::string& warning : acceptance.warnings) ROS_WARN_STREAM(warning);
  // Its result cannot have been handled yet: that is done by this same thread.
  goals_.emplace(acceptance.id, handle);
  handle.setAccepted();
}

void TrajectoryActionServer::on_cancel(const Handle& handle) {
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
