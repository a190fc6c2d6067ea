#pragma once

#include <string>
#include <vector>

#include <control_msgs/QueryTrajectoryState.h>
#include <interpolated_motion_driver/GetMotionReport.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// The services that only ask: `~query_state` and `~motion_report`.
class QueryServices {
 public:
  QueryServices(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints);

 private:
  using Query = control_msgs::QueryTrajectoryState;
  using Report = interpolated_motion_driver::GetMotionReport;

  bool query_state(Query::Request& request, Query::Response& response);
  bool motion_report(Report::Request& request, Report::Response& response);

  HardwareThread& hardware_;
  const std::vector<std::string> joints_;
  ros::ServiceServer query_state_;
  ros::ServiceServer motion_report_;
};

}  // namespace interpolated_motion::node
