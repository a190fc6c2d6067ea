#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/link_frames.h"

namespace interpolated_motion::node {

/// Publishes the link frames of the robot on `/tf` and `/tf_static`: where the joints are, and, with a prefix
/// to the links' names, where the trajectory has them. Both start in the root link.
class LinkFramePublisher {
 public:
  /// Without a `demand_prefix` the trajectory's frames are left out.
  LinkFramePublisher(LinkFrames frames, std::string demand_prefix, const HardwareThread& hardware);

  /// A drive that does not answer leaves its link out, and so does a time that has been published.
  void publish();

 private:
  using Transforms = std::vector<geometry_msgs::TransformStamped>;

  void publish_fixed();
  void add(const std::vector<LinkFrames::Frame>& frames, const std::string& prefix, ros::Time stamp,
           Transforms& transforms) const;
  std::vector<double> positions(trajectory::State motion::JointSnapshot::*state) const;

  const LinkFrames frames_;
  const std::string demand_prefix_;
  const HardwareThread& hardware_;
  motion::Snapshot snapshot_;
  HostTime published_{};
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
};

}  // namespace interpolated_motion::node
