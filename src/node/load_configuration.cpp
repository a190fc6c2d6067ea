#include "interpolated_motion_driver/node/load_configuration.h"

#include <stdexcept>

#include <fmt/format.h>
#include <ros/console.h>

#include "interpolated_motion_driver/node/xmlrpc_to_yaml.h"

namespace interpolated_motion::node {
namespace {

YAML::Node read_parameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue value;
  const std::string& name = private_node.getNamespace();
  if (!private_node.getParam(name, value) || value.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    throw std::invalid_argument(fmt::format(
        "There are no parameters under {}; load a configuration there, as launch/driver.launch does.", name));
  }
  return xmlrpc_to_yaml(value);
}

RobotDescription find_robot_description(const ros::NodeHandle& private_node, const std::string& file) {
  std::string key;
  RobotDescription description;
  if (private_node.searchParam("robot_description", key) && private_node.getParam(key, description.urdf)) {
    description.source = "the URDF in parameter " + key;
    if (!file.empty()) {
      ROS_WARN_STREAM("robot_description_file ("
                      << file << ") is not read, since there is a parameter " << key
                      << ", which may be left from an earlier launch; `rosparam delete " << key
                      << "` removes it");
    }
    return description;
  }
  if (!file.empty()) return read_robot_description_file(file);
  throw std::invalid_argument(
      "no robot description: set the parameter 'robot_description' to the URDF, or 'robot_description_file' "
      "to its file");
}

/// The joint names as far as they are well formed; parse_configuration() says what is wrong with the rest.
std::vector<std::string> joint_names(const YAML::Node& parameters) {
  std::vector<std::string> names;
  const YAML::Node joints = parameters["joints"];
  if (!joints || !joints.IsSequence()) return names;
  for (const YAML::Node& joint : joints) {
    if (joint.IsScalar()) names.push_back(joint.Scalar());
  }
  return names;
}

void mention_ignored(const YAML::Node& parameters) {
  for (const std::string& key : ignored_controller_keys(parameters)) {
    ROS_INFO_STREAM("Parameter " << key << " is ignored: the drives close their position loops themselves");
  }
}

}  // namespace

LoadedConfiguration load_configuration(const ros::NodeHandle& private_node) {
  const YAML::Node parameters = read_parameters(private_node);
  mention_ignored(parameters);
  LoadedConfiguration loaded;
  loaded.node = parse_node_parameters(parameters);
  loaded.robot_description = find_robot_description(private_node, loaded.node.robot_description_file);
  const auto limits = joint_limits(loaded.robot_description, joint_names(parameters));
  loaded.driver = hardware::parse_configuration(parameters, limits, node_parameter_keys());
  return loaded;
}

}  // namespace interpolated_motion::node
