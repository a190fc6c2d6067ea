#include "interpolated_motion_driver/node/link_frames.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tf2/LinearMath/Quaternion.h>
#include <urdf_model/model.h>

namespace interpolated_motion::node {
namespace {

tf2::Transform transform_of(const urdf::Pose& pose) {
  tf2::Quaternion rotation;
  pose.rotation.getQuaternion(rotation[0], rotation[1], rotation[2], rotation[3]);
  return tf2::Transform(rotation, tf2::Vector3(pose.position.x, pose.position.y, pose.position.z));
}

tf2::Vector3 axis_of(const urdf::Joint& joint) {
  return tf2::Vector3(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
}

bool has_one_axis(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
         joint.type == urdf::Joint::PRISMATIC;
}

std::optional<std::size_t> index_of(const std::string& joint, const std::vector<std::string>& joints) {
  const auto found = std::find(joints.begin(), joints.end(), joint);
  if (found == joints.end()) return std::nullopt;
  return static_cast<std::size_t>(found - joints.begin());
}

}  // namespace

LinkFrames::LinkFrames(const RobotDescription& description, const std::vector<std::string>& joints) {
  const auto model = parse_urdf(description);
  root_ = model->getRoot()->name;
  for (const auto& [name, joint] : model->joints_) {
    const tf2::Transform origin = transform_of(joint->parent_to_joint_origin_transform);
    const std::string& parent = joint->parent_link_name;
    const std::string& child = joint->child_link_name;
    if (joint->type == urdf::Joint::FIXED) fixed_.push_back({parent, child, origin});
    const auto driven = index_of(joint->mimic ? joint->mimic->joint_name : name, joints);
    if (!driven || !has_one_axis(*joint)) continue;
    Movable movable{parent, child, origin, axis_of(*joint), joint->type == urdf::Joint::PRISMATIC, *driven};
    if (joint->mimic) {
      movable.multiplier = joint->mimic->multiplier;
      movable.offset = joint->mimic->offset;
    }
    movable_.push_back(movable);
  }
}

std::vector<LinkFrames::Frame> LinkFrames::moved(const std::vector<double>& positions) const {
  std::vector<Frame> frames;
  for (const Movable& joint : movable_) {
    const double position = joint.multiplier * positions[joint.driven_by] + joint.offset;
    if (std::isnan(position)) continue;
    tf2::Transform motion = tf2::Transform::getIdentity();
    if (joint.prismatic) {
      motion.setOrigin(joint.axis * position);
    } else {
      motion.setRotation(tf2::Quaternion(joint.axis, position));
    }
    frames.push_back({joint.parent, joint.child, joint.origin * motion});
  }
  return frames;
}

}  // namespace interpolated_motion::node
