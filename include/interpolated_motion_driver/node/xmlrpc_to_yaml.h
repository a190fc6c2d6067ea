#pragma once

#include <XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

namespace interpolated_motion::node {

/// A value of the ROS parameter server as the YAML it was loaded from: structs become maps, arrays sequences,
/// everything else scalars. Doubles keep all their digits. Strings are scalars as they stand, so that `1e-3`,
/// which the parameter server's YAML 1.1 takes for a string, is a number again. Throws std::invalid_argument
/// for binary and date values, which YAML parameters do not produce.
YAML::Node xmlrpc_to_yaml(XmlRpc::XmlRpcValue value);

}  // namespace interpolated_motion::node
