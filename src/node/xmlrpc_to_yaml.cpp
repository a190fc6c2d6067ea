#include "interpolated_motion_driver/node/xmlrpc_to_yaml.h"

#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::node {
namespace {

YAML::Node map_of(XmlRpc::XmlRpcValue& value) {
  YAML::Node map(YAML::NodeType::Map);
  for (auto& entry : value) map[entry.first] = xmlrpc_to_yaml(entry.second);
  return map;
}

YAML::Node sequence_of(XmlRpc::XmlRpcValue& value) {
  YAML::Node sequence(YAML::NodeType::Sequence);
  for (int i = 0; i < value.size(); ++i) sequence.push_back(xmlrpc_to_yaml(value[i]));
  return sequence;
}

}  // namespace

YAML::Node xmlrpc_to_yaml(XmlRpc::XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct:
      return map_of(value);
    case XmlRpc::XmlRpcValue::TypeArray:
      return sequence_of(value);
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(fmt::format("{:.17g}", static_cast<double>(value)));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpc::XmlRpcValue::TypeInvalid:
      return YAML::Node(YAML::NodeType::Map);
    default:
      throw std::invalid_argument(
          "A parameter has a binary or date value; it must be a number, text, list or map.");
  }
}

}  // namespace interpolated_motion::node
