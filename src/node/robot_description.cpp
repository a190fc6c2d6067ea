#include "interpolated_motion_driver/node/robot_description.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <ros/package.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "interpolated_motion_driver/command_line/input_file.h"

namespace interpolated_motion::node {
namespace {

/// Only joints with one axis of their own can be driven.
void refuse_undrivable(const urdf::Joint& joint, const std::string& source) {
  if (joint.mimic) {
    throw std::invalid_argument(
        fmt::format("Parameter joints names {}, which mimics {} in {}; configure the joint that it mimics.",
                    joint.name, joint.mimic->joint_name, source));
  }
  const bool one_axis = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
                        joint.type == urdf::Joint::PRISMATIC;
  if (one_axis) return;
  throw std::invalid_argument(
      fmt::format("Parameter joints names {}, which is {} in {}; only revolute, continuous and "
                  "prismatic joints can be driven.",
                  joint.name, joint.type == urdf::Joint::FIXED ? "fixed" : "floating or planar", source));
}

/// The soft limits of <safety_controller>, where a robot has some: both are 0 where it has not.
void tighten_by_soft_limits(const urdf::Joint& joint, trajectory::JointLimits& limits) {
  if (!joint.safety || !(joint.safety->soft_lower_limit < joint.safety->soft_upper_limit)) return;
  limits.min_position = std::max(limits.min_position, joint.safety->soft_lower_limit);
  limits.max_position = std::min(limits.max_position, joint.safety->soft_upper_limit);
}

/// What is left of a xacro file that nobody has expanded, if anything.
std::string xacro_of(const std::string& text) {
  for (const char* sign : {"<xacro:", "${", "$(arg ", "$(find "}) {
    if (text.find(sign) != std::string::npos) return sign;
  }
  return {};
}

trajectory::JointLimits limits_of(const urdf::Joint& joint, const std::string& source) {
  trajectory::JointLimits limits;
  limits.continuous = joint.type == urdf::Joint::CONTINUOUS;
  if (joint.type == urdf::Joint::PRISMATIC) limits.unit = trajectory::JointUnit::Metre;
  if (!joint.limits) return limits;
  if (!(joint.limits->velocity >= 0.0)) {
    throw std::invalid_argument(fmt::format("Joint {} has the velocity limit {:g} in {}; it must be above 0.",
                                            joint.name, joint.limits->velocity, source));
  }
  limits.max_velocity = joint.limits->velocity;
  if (limits.continuous) return limits;
  if (!(joint.limits->lower < joint.limits->upper)) {
    throw std::invalid_argument(
        fmt::format("Joint {} has the position limits {:g} to {:g} in {}; the lower one must be the smaller.",
                    joint.name, joint.limits->lower, joint.limits->upper, source));
  }
  limits.min_position = joint.limits->lower;
  limits.max_position = joint.limits->upper;
  tighten_by_soft_limits(joint, limits);
  return limits;
}

const std::string kPackageScheme = "package://";

std::string resolve(const std::string& path) {
  if (path.compare(0, kPackageScheme.size(), kPackageScheme) != 0) return path;
  const std::string rest = path.substr(kPackageScheme.size());
  const std::size_t slash = rest.find('/');
  const std::string package = rest.substr(0, slash);
  const std::string folder = ros::package::getPath(package);
  if (folder.empty() || slash == std::string::npos) {
    throw std::invalid_argument(fmt::format(
        "Parameter robot_description_file is {}; is the package {} on ROS_PACKAGE_PATH?", path, package));
  }
  return folder + rest.substr(slash);
}

}  // namespace

urdf::ModelInterfaceSharedPtr parse_urdf(const RobotDescription& description) {
  if (const std::string xacro = xacro_of(description.urdf); !xacro.empty()) {
    throw std::invalid_argument(fmt::format(
        "{} is xacro (it has \"{}\"), not URDF; run xacro first: `rosrun xacro xacro FILE > robot.urdf`, or "
        "<param name=\"robot_description\" command=\"xacro FILE\"/> in the launch file.",
        description.source, xacro));
  }
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(description.urdf);
  if (!model) {
    throw std::invalid_argument(fmt::format(
        "{} is no valid URDF; the parser's message on the console says where.", description.source));
  }
  return model;
}

std::map<std::string, trajectory::JointLimits> joint_limits(const RobotDescription& description,
                                                            const std::vector<std::string>& joints) {
  const auto model = parse_urdf(description);
  std::map<std::string, trajectory::JointLimits> limits;
  for (const std::string& name : joints) {
    const auto joint = model->getJoint(name);
    if (!joint) {
      throw std::invalid_argument(
          fmt::format("Parameter joints names {}, which is no joint of {}; check the spelling.", name,
                      description.source));
    }
    refuse_undrivable(*joint, description.source);
    limits.emplace(name, limits_of(*joint, description.source));
  }
  return limits;
}

RobotDescription read_robot_description_file(const std::string& path) {
  const std::string file = resolve(path);
  try {
    return {command_line::read_text_file(file), file};
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(fmt::format("Parameter robot_description_file: {}.", error.what()));
  }
}

}  // namespace interpolated_motion::node
