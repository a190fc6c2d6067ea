#include "interpolated_motion_driver/node/shutdown_request.h"

#include <utility>

#include <ros/console.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

namespace interpolated_motion::node {
namespace {

/// `parameters` are the caller's name and his reason (ROS slave API, `shutdown`).
void log_request(XmlRpc::XmlRpcValue& parameters) {
  const bool has_reason = parameters.getType() == XmlRpc::XmlRpcValue::TypeArray && parameters.size() > 1 &&
                          parameters[1].getType() == XmlRpc::XmlRpcValue::TypeString;
  ROS_WARN_STREAM("somebody ends this node: " << (has_reason ? static_cast<std::string>(parameters[1])
                                                             : "no reason given"));
}

}  // namespace

void on_shutdown_request(std::function<void()> stop) {
  const ros::XMLRPCManagerPtr& manager = ros::XMLRPCManager::instance();
  manager->unbind("shutdown");
  manager->bind("shutdown",
                [stop = std::move(stop)](XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
                  log_request(parameters);
                  stop();
                  result = ros::xmlrpc::responseInt(1, "", 0);
                });
}

}  // namespace interpolated_motion::node
