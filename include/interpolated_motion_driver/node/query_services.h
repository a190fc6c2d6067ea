#pragma once

#include <string>
#include <vector>

#include <control_msgs/QueryTrajectoryState.h>
#include <interpolated_motion_driver/GetMotionReport.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// The services that only ask: `~query_state` and `~motion_report`. The report tells how the drives of
/// another program's emulation have followed, too, when that writes their samples into a folder.
class QueryServices {
 public:
  /// `samples_folder`: that of `emulated_drives --samples`; empty: none.
  QueryServices(ros::NodeHandle node, HardwareThread& hardware, std::vector<std::string> joints,
                std::string samples_folder);

 private:
  using Query = control_msgs::QueryTrajectoryState;
  using Report = interpolated_motion_driver::GetMotionReport;

  bool query_state(Query::Request& request, Query::Response& response);
  bool motion_report(Report::Request& request, Report::Response& response);

  void hand_over_samples(std::size_t joint);

  HardwareThread& hardware_;
  const std::vector<std::string> joints_;
  const std::string samples_folder_;
  ros::ServiceServer query_state_;
  ros::ServiceServer motion_report_;
};

}  // namespace interpolated_motion::node
