#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include "interpolated_motion_driver/node/action_server.h"
#include "interpolated_motion_driver/node/bring_up.h"
#include "interpolated_motion_driver/node/command_topic.h"
#include "interpolated_motion_driver/node/control_services.h"
#include "interpolated_motion_driver/node/diagnostics.h"
#include "interpolated_motion_driver/node/fault_injection.h"
#include "interpolated_motion_driver/node/hardware_thread.h"
#include "interpolated_motion_driver/node/link_frame_publisher.h"
#include "interpolated_motion_driver/node/load_configuration.h"
#include "interpolated_motion_driver/node/periodic_calls.h"
#include "interpolated_motion_driver/node/query_services.h"
#include "interpolated_motion_driver/node/queue_thread.h"
#include "interpolated_motion_driver/node/service_queue.h"
#include "interpolated_motion_driver/node/setpoint_topic.h"
#include "interpolated_motion_driver/node/state_publisher.h"
#include "interpolated_motion_driver/node/status_publisher.h"
#include "interpolated_motion_driver/node/wire_log.h"

namespace interpolated_motion::node {

/// The ROS side of the driver. Its threads:
/// - the bus thread (HardwareThread) owns drives and buses;
/// - planning (PlannerThread): goals, one after the other;
/// - commands: action, `~command`, `~setpoints`, `~query_state` (the caller of run());
/// - publishing: everything that is published at a rate, and the log;
/// - services: requests that take seconds; several, so that none waits for another;
/// - halt: `~halt` and nothing else.
/// What commands and publishing have lives in one thread, so no part needs a lock; requests have no state.
class DriverNode {
 public:
  /// Starts the bus thread. Throws std::invalid_argument, std::runtime_error (a bus or a file cannot be
  /// opened).
  explicit DriverNode(const LoadedConfiguration& configuration);

  /// Serves until `stop` is set, ROS shuts down, or the bus thread fails; then brings the drives to rest and
  /// switches them off. Returns the exit code of the program.
  int run(const std::atomic<bool>& stop);

 private:
  std::unique_ptr<HardwareThread> start_hardware(const LoadedConfiguration& configuration);
  HardwareThread::Listener listener();
  void log(const HardwareThread::Hardware::LogEntry& entry);
  void call_periodically(const NodeParameters& parameters);
  void bring_up(const std::function<bool()>& running);
  void announce();
  int finish();

  ros::CallbackQueue command_queue_;
  ros::CallbackQueue publish_queue_;
  ServiceQueue services_;
  ServiceQueue halt_;
  PeriodicCalls commanding_;
  PeriodicCalls publishing_;

  std::unique_ptr<WireLog> wire_log_;
  std::atomic<bool> failed_{false};
  std::unique_ptr<HardwareThread> hardware_;

  TrajectoryActionServer action_;
  CommandTopic command_;
  SetpointTopic setpoints_;
  QueryServices queries_;
  ControlServices controls_;
  std::unique_ptr<FaultInjection> faults_;
  StatePublisher states_;
  StatusPublisher status_;
  std::unique_ptr<LinkFramePublisher> link_frames_;
  Diagnostics diagnostics_;

  BringUp bring_up_;
  motion::Snapshot snapshot_;

  QueueThread publisher_;
};

}  // namespace interpolated_motion::node
