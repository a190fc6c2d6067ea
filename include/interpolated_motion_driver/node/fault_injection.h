#pragma once

#include <interpolated_motion_driver/InjectFault.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// The service `~inject_fault`: makes an emulated drive fail. Only offered when the parameter
/// allow_fault_injection is set.
class FaultInjection {
 public:
  /// Advertises below `node`; calls come from its callback queue. `hardware` must live longer.
  FaultInjection(ros::NodeHandle node, HardwareThread& hardware);

 private:
  using Service = interpolated_motion_driver::InjectFault;

  bool inject(Service::Request& request, Service::Response& response);

  HardwareThread& hardware_;
  ros::ServiceServer server_;
};

}  // namespace interpolated_motion::node
