#pragma once

#include <map>
#include <string>
#include <vector>

#include <urdf_world/types.h>

#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::node {

/// A URDF and where it came from, for messages.
struct RobotDescription {
  std::string urdf;    ///< the XML text
  std::string source;  ///< e.g. "parameter /robot_description"
};

/// Throws std::invalid_argument with the source when the text is no URDF.
urdf::ModelInterfaceSharedPtr parse_urdf(const RobotDescription& description);

/// Position and velocity limits of `joints` as the URDF has them, and whether they are continuous or
/// prismatic; a URDF has no acceleration limits. Throws std::invalid_argument with joint and source when the
/// text is no URDF, a joint is not in it, is fixed, mimics another or has more than one axis, or when its
/// limits make no sense.
std::map<std::string, trajectory::JointLimits> joint_limits(const RobotDescription& description,
                                                            const std::vector<std::string>& joints);

/// Reads a URDF file. `path` is a file name, or `package://PACKAGE/...`. Throws std::invalid_argument when it
/// cannot be read.
RobotDescription read_robot_description_file(const std::string& path);

}  // namespace interpolated_motion::node
