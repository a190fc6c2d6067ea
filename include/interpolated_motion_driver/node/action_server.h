#pragma once

#include <map>
#include <string>

#include <actionlib/server/action_server.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <ros/node_handle.h>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/log_throttle.h"

namespace interpolated_motion::node {

/// The action `~follow_joint_trajectory`, as joint_trajectory_controller has it: a plain action server, so
/// that a new goal replaces the one under way, whoever sent it. All its callbacks, and goal_ended(), run in
/// the one thread that serves the node handle's callback queue.
class TrajectoryActionServer {
 public:
  /// Clients do not see the server before start().
  TrajectoryActionServer(const ros::NodeHandle& node, HardwareThread& hardware);

  /// Announces the server: from now on goals are taken.
  void start();

  /// Accepts or rejects the client's goal. Answers to trajectories of the command topic are ignored.
  void goal_answered(const hardware::GoalAnswer& answer);

  /// Ends the client's goal as the motion has ended. Results of trajectories that came by the command topic
  /// are ignored.
  void goal_ended(const motion::GoalResult& result);

  /// The driver ends: goals that have not been answered are rejected.
  void reject_unanswered();

  /// Tells the client of the goal under way where the joints are, if there is one.
  void publish_feedback();

 private:
  using Server = actionlib::ActionServer<control_msgs::FollowJointTrajectoryAction>;
  using Handle = Server::GoalHandle;

  void on_goal(Handle handle);
  void reject(Handle& handle, const Refusal& refusal);
  void on_cancel(const Handle& handle);

  HardwareThread& hardware_;
  ros::NodeHandle node_;
  std::map<hardware::Ticket, Handle> handed_in_;  ///< neither accepted nor rejected
  std::map<motion::GoalId, Handle> goals_;        ///< accepted and not yet ended
  LogThrottle rejected_;
  LogThrottle aborted_;
  motion::Snapshot snapshot_;
  control_msgs::FollowJointTrajectoryFeedback feedback_;
  Server server_;
};

}  // namespace interpolated_motion::node
