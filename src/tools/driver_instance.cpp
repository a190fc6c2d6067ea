#include "driver_instance.h"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/this_node.h>

namespace interpolated_motion::tools {
namespace {

std::optional<std::string> address_of(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue address;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, address, false)) return std::nullopt;
  return static_cast<std::string>(address);
}

}  // namespace

DriverInstance::DriverInstance(const std::string& node) : node_(ros::names::resolve(node)) {}

bool DriverInstance::found() {
  if (!address_) address_ = address_of(node_);
  return address_.has_value();
}

bool DriverInstance::is_there() const { return address_ && address_of(node_) == address_; }

}  // namespace interpolated_motion::tools
