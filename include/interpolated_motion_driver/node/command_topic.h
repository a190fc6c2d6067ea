#pragma once

#include <set>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/log_throttle.h"

namespace interpolated_motion::node {

/// The topic `~command`: trajectories without feedback. One that is accepted replaces whatever is under way,
/// a goal of the action too; one without points stops; one that is refused is logged and changes nothing.
class CommandTopic {
 public:
  /// Subscribes below `node`; calls come from its callback queue. `joints`: all of them, in the driver's
  /// order. `hardware` must live longer.
  CommandTopic(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints);

  /// Logs what has become of a trajectory. Answers to goals of the action are ignored.
  void goal_answered(const hardware::GoalAnswer& answer);

 private:
  void on_command(const trajectory_msgs::JointTrajectory& message);

  HardwareThread& hardware_;
  const std::vector<std::string> joints_;
  std::set<hardware::Ticket> handed_in_;
  LogThrottle refused_;
  ros::Subscriber subscriber_;
};

}  // namespace interpolated_motion::node
