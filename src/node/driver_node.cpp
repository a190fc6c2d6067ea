#include "interpolated_motion_driver/node/driver_node.h"

#include <utility>

#include <ros/console.h>
#include <ros/init.h>

#include "interpolated_motion_driver/node/callback_post.h"

namespace interpolated_motion::node {
namespace {

constexpr HostDuration kShutdownPatience = std::chrono::seconds(2);
/// How long the command thread sleeps at most before it looks whether to stop.
const ros::WallDuration kGlance(0.1);

ros::NodeHandle private_node(ros::CallbackQueue& queue) {
  ros::NodeHandle node("~");
  node.setCallbackQueue(&queue);
  return node;
}

std::unique_ptr<WireLog> open_wire_log(const LoadedConfiguration& configuration) {
  if (configuration.node.wire_log.empty()) return nullptr;
  std::vector<std::string> buses;
  for (const auto& bus : configuration.driver.buses) buses.push_back(bus.name);
  return std::make_unique<WireLog>(configuration.node.wire_log, wall_clock_offset(), std::move(buses));
}

}  // namespace

DriverNode::DriverNode(const LoadedConfiguration& configuration)
    : wire_log_(open_wire_log(configuration)),
      hardware_(start_hardware(configuration)),
      action_(private_node(command_queue_), *hardware_, configuration.node.action_monitor_rate),
      command_(private_node(command_queue_), *hardware_, configuration.driver.joints),
      setpoints_(private_node(command_queue_), *hardware_),
      queries_(private_node(command_queue_), *hardware_, configuration.driver.joints,
               configuration.node.emulated_samples),
      controls_(private_node(service_queue_), *hardware_),
      states_(private_node(publish_queue_), *hardware_, configuration.node.state_publish_rate),
      status_(private_node(publish_queue_), *hardware_, configuration.node.status_publish_rate),
      diagnostics_(private_node(publish_queue_), *hardware_, configuration.driver, wire_log_.get()),
      bring_up_(configuration.driver.enable_on_start),
      bring_up_timer_(
          private_node(command_queue_)
              .createSteadyTimer(ros::WallDuration(0.02), [this](const auto&) { watch_bring_up(); })),
      publish_spinner_(1, &publish_queue_),
      service_spinner_(1, &service_queue_) {
  if (configuration.node.allow_fault_injection) {
    faults_ = std::make_unique<FaultInjection>(private_node(command_queue_), *hardware_);
  }
}

std::unique_ptr<HardwareThread> DriverNode::start_hardware(const LoadedConfiguration& configuration) {
  const auto make = [&](const hardware::EventLoop& loop) {
    auto hardware = std::make_unique<hardware::MotionHardware>(configuration.driver, host_now(), loop);
    if (wire_log_) {
      const auto append = [this](const std::string& bus, const auto& traffic) {
        wire_log_->append(bus, traffic);
      };
      hardware->set_wire_observer({append, append});
    }
    return hardware;
  };
  const HardwareThread::Settings settings{host_duration(configuration.node.loop_period),
                                          configuration.node.realtime_priority};
  return std::make_unique<HardwareThread>(make, settings, listener());
}

HardwareThread::Listener DriverNode::listener() {
  return {[this](const motion::GoalResult& result) {
            post_to(command_queue_, [this, result] { action_.goal_ended(result); });
          },
          [this](const HardwareThread::Hardware::LogEntry& entry) {
            post_to(publish_queue_, [this, entry] { log(entry); });
          },
          [this](const std::string& error) {
            failed_ = true;
            post_to(command_queue_, [error] { ROS_FATAL_STREAM("the bus thread has failed: " << error); });
          }};
}

void DriverNode::log(const HardwareThread::Hardware::LogEntry& entry) {
  using Severity = HardwareThread::Hardware::Severity;
  switch (entry.severity) {
    case Severity::Debug:
      ROS_DEBUG_STREAM(entry.text);
      return;
    case Severity::Info:
      ROS_INFO_STREAM(entry.text);
      return;
    case Severity::Warning:
      ROS_WARN_STREAM(entry.text);
      return;
    case Severity::Error:
      ROS_ERROR_STREAM(entry.text);
      return;
  }
}

void DriverNode::watch_bring_up() {
  hardware_->snapshot(snapshot_);
  if (!bring_up_.update(snapshot_.state)) {
    ROS_INFO_STREAM_THROTTLE(5.0, "waiting for the drives: " << motion::to_string(snapshot_.state));
    return;
  }
  bring_up_timer_.stop();
  action_.start();
  if (snapshot_.state == motion::GroupState::Fault) {
    ROS_ERROR_STREAM("the drives are in fault: " << snapshot_.fault);
  } else {
    ROS_INFO_STREAM("ready for goals: " << motion::to_string(snapshot_.state));
  }
}

int DriverNode::run(const volatile std::sig_atomic_t& stop) {
  publish_spinner_.start();
  service_spinner_.start();
  while (stop == 0 && ros::ok() && !failed_) command_queue_.callAvailable(kGlance);
  return finish();
}

int DriverNode::finish() {
  // New goals wait in the queue from here on; they are never taken.
  if (!failed_) hardware_->shut_down(kShutdownPatience);
  // What the bus thread has said last: results of goals that the stop has ended, or why it failed.
  command_queue_.callAvailable();
  service_spinner_.stop();
  publish_spinner_.stop();
  publish_queue_.callAvailable();
  if (wire_log_ && wire_log_->lost() > 0) {
    ROS_WARN_STREAM(wire_log_->lost() << " frames are missing in " << wire_log_->path());
  }
  return failed_ ? 1 : 0;
}

}  // namespace interpolated_motion::node
