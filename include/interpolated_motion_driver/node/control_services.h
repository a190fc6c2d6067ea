#pragma once

#include <functional>

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/recording_writer.h"
#include "interpolated_motion_driver/node/speed_interface.h"

namespace interpolated_motion::node {

/// The services that change the state of the drives: `~enable`, `~reset_faults`, `~halt` and
/// `~clear_buffers`. Each answers when it is done, which takes seconds; so they are served by threads of
/// their own, and `~halt` by threads that serve nothing else. And those that change the speed of motion.
class ControlServices {
 public:
  /// Advertises below the name of `node`. `~halt` is served by the queue of `halt_node`, the others by that
  /// of `node`; those who serve them must be free to wait. `hardware` must live longer.
  ControlServices(ros::NodeHandle node, ros::NodeHandle halt_node, HardwareThread& hardware,
                  const hardware::RecorderConfiguration& recorder);

  /// A recording of a fault that is not written yet is, while `hardware` still runs.
  void finish_recordings() { recordings_.stop(); }

 private:
  using Start = std::function<motion::RequestId(HardwareThread::Hardware&, HostTime)>;

  ros::ServiceServer advertise_trigger(ros::NodeHandle& node, const std::string& name, Start start);
  bool enable(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  HardwareThread& hardware_;
  ros::ServiceServer enable_;
  ros::ServiceServer reset_faults_;
  ros::ServiceServer halt_;
  ros::ServiceServer clear_buffers_;
  SpeedInterface speed_;
  RecordingWriter recordings_;
};

}  // namespace interpolated_motion::node
