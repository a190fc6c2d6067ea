#include "interpolated_motion_driver/node/link_frame_publisher.h"

#include <limits>
#include <utility>

#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {

LinkFramePublisher::LinkFramePublisher(LinkFrames frames, std::string demand_prefix,
                                       const HardwareThread& hardware)
    : frames_(std::move(frames)), demand_prefix_(std::move(demand_prefix)), hardware_(hardware) {
  publish_fixed();
}

void LinkFramePublisher::publish_fixed() {
  Transforms transforms;
  add(frames_.fixed(), "", ros::Time::now(), transforms);
  if (!demand_prefix_.empty()) {
    add(frames_.fixed(), demand_prefix_, ros::Time::now(), transforms);
    const LinkFrames::Frame root{frames_.root(), demand_prefix_ + frames_.root(),
                                 tf2::Transform::getIdentity()};
    add({root}, "", ros::Time::now(), transforms);
  }
  static_broadcaster_.sendTransform(transforms);
}

void LinkFramePublisher::publish() {
  hardware_.snapshot(snapshot_);
  if (snapshot_.state == motion::GroupState::Starting || snapshot_.time == published_) return;
  published_ = snapshot_.time;
  const ros::Time stamp = to_ros_time(snapshot_.time);
  Transforms transforms;
  add(frames_.moved(positions(&motion::JointSnapshot::actual)), "", stamp, transforms);
  if (!demand_prefix_.empty())
    add(frames_.moved(positions(&motion::JointSnapshot::desired)), demand_prefix_, stamp, transforms);
  broadcaster_.sendTransform(transforms);
}

std::vector<double> LinkFramePublisher::positions(trajectory::State motion::JointSnapshot::*state) const {
  std::vector<double> positions;
  for (const motion::JointSnapshot& joint : snapshot_.joints) {
    positions.push_back(joint.online ? (joint.*state).position : std::numeric_limits<double>::quiet_NaN());
  }
  return positions;
}

void LinkFramePublisher::add(const std::vector<LinkFrames::Frame>& frames, const std::string& prefix,
                             ros::Time stamp, Transforms& transforms) const {
  for (const LinkFrames::Frame& frame : frames) {
    geometry_msgs::TransformStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = prefix + frame.parent;
    message.child_frame_id = prefix + frame.child;
    const tf2::Vector3& origin = frame.transform.getOrigin();
    message.transform.translation.x = origin.x();
    message.transform.translation.y = origin.y();
    message.transform.translation.z = origin.z();
    const tf2::Quaternion rotation = frame.transform.getRotation();
    message.transform.rotation.x = rotation.x();
    message.transform.rotation.y = rotation.y();
    message.transform.rotation.z = rotation.z();
    message.transform.rotation.w = rotation.w();
    transforms.push_back(message);
  }
}

}  // namespace interpolated_motion::node
