#include "interpolated_motion_driver/node/command_topic.h"

#include <utility>

#include <ros/console.h>

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {

CommandTopic::CommandTopic(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints)
    : hardware_(hardware), joints_(std::move(joints)) {
  subscriber_ = node.subscribe("command", 1, &CommandTopic::on_command, this);
}

void CommandTopic::on_command(const trajectory_msgs::JointTrajectory& message) {
  trajectory::Goal goal = to_goal(message);
  // On the topic an empty message stops, whatever joints it names; for a goal the names have to be right.
  if (goal.points.empty()) goal.joint_names = joints_;
  if (const auto ticket = hardware_.submit(std::move(goal))) handed_in_.insert(*ticket);
}

void CommandTopic::goal_answered(const hardware::GoalAnswer& answer) {
  if (handed_in_.erase(answer.ticket) == 0) return;
  if (!answer.answer) {
    const auto line = refused_.pass("command ignored: " + answer.answer.error().text, host_now());
    if (line) ROS_ERROR_STREAM(*line);
    return;
  }
  for (const std::string& warning : answer.answer.value().warnings) ROS_WARN_STREAM(warning);
}

}  // namespace interpolated_motion::node
