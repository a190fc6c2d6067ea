#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tf2/LinearMath/Transform.h>
#include <tf2/LinearMath/Vector3.h>

#include "interpolated_motion_driver/node/robot_description.h"

namespace interpolated_motion::node {

/// The links of a robot as coordinate frames, each in its parent link. Joints of the URDF that are neither
/// driven nor fixed, and mimic no driven one, are left out: who moves them knows where their links are.
class LinkFrames {
 public:
  struct Frame {
    std::string parent;        ///< link, as the URDF names it
    std::string child;         ///< link, as the URDF names it
    tf2::Transform transform;  ///< of the child in the parent; m
  };

  /// `joints`: the driven ones, joints of the URDF with one axis. Throws std::invalid_argument when the text
  /// is no URDF.
  LinkFrames(const RobotDescription& description, const std::vector<std::string>& joints);

  /// The link that is no child.
  const std::string& root() const { return root_; }
  /// Links that fixed joints hold.
  const std::vector<Frame>& fixed() const { return fixed_; }
  /// Links that the driven joints move, at `positions` (rad or m) of those, in their order. A joint whose
  /// position is NaN is left out.
  std::vector<Frame> moved(const std::vector<double>& positions) const;

 private:
  struct Movable {
    std::string parent;         ///< link, as the URDF names it
    std::string child;          ///< link, as the URDF names it
    tf2::Transform origin;      ///< of the child in the parent at position 0; m
    tf2::Vector3 axis;          ///< of unit length, in the frame of the joint
    bool prismatic = false;     ///< moves along `axis`, m; else turns about it, rad
    std::size_t driven_by = 0;  ///< index of the driven joint
    double multiplier = 1.0;    ///< of its position, and
    double offset = 0.0;        ///< what is added, for a joint that mimics it
  };

  std::string root_;
  std::vector<Frame> fixed_;
  std::vector<Movable> movable_;
};

}  // namespace interpolated_motion::node
