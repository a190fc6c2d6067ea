#include "interpolated_motion_driver/node/driver_node.h"

#include <utility>

#include <ros/console.h>
#include <ros/init.h>

#include "interpolated_motion_driver/node/callback_post.h"

namespace interpolated_motion::node {
namespace {

constexpr HostDuration kShutdownPatience = std::chrono::seconds(2);
/// How often the node looks how far the drives have come up.
const ros::WallDuration kBringUpGlance(0.02);
constexpr double kDiagnosticsRate = 1.0;  ///< Hz
/// One for each request that may be under way at a time: enable, disable, reset, clear.
constexpr unsigned kServiceThreads = 4;
/// A halt is not to wait for the answer to another one.
constexpr unsigned kHaltThreads = 2;

ros::NodeHandle private_node(ros::CallbackQueue& queue) {
  ros::NodeHandle node("~");
  node.setCallbackQueue(&queue);
  return node;
}

std::unique_ptr<WireLog> open_wire_log(const LoadedConfiguration& configuration) {
  if (configuration.node.wire_log.empty()) return nullptr;
  std::vector<std::string> buses;
  for (const auto& bus : configuration.driver.buses) buses.push_back(bus.name);
  auto log = std::make_unique<WireLog>(configuration.node.wire_log, wall_clock_offset(), std::move(buses));
  ROS_INFO_STREAM("all bus traffic goes to " << log->path());
  return log;
}

}  // namespace

DriverNode::DriverNode(const LoadedConfiguration& configuration)
    : services_(kServiceThreads),
      halt_(kHaltThreads),
      commanding_(host_now()),
      publishing_(host_now()),
      wire_log_(open_wire_log(configuration)),
      hardware_(start_hardware(configuration)),
      action_(private_node(command_queue_), *hardware_),
      command_(private_node(command_queue_), *hardware_, configuration.driver.joints),
      setpoints_(private_node(command_queue_), *hardware_),
      queries_(private_node(command_queue_), *hardware_, configuration.driver.joints,
               configuration.node.emulated_samples),
      controls_(private_node(services_.queue()), private_node(halt_.queue()), *hardware_,
                configuration.driver.flight_recorder),
      states_(private_node(publish_queue_), *hardware_),
      status_(private_node(publish_queue_), *hardware_),
      diagnostics_(private_node(publish_queue_), *hardware_, configuration.driver, wire_log_.get()),
      bring_up_(configuration.driver.enable_on_start),
      publisher_(publish_queue_, publishing_) {
  if (configuration.node.allow_fault_injection) {
    faults_ = std::make_unique<FaultInjection>(private_node(command_queue_), *hardware_);
  }
  if (configuration.node.publish_tf) {
    link_frames_ = std::make_unique<LinkFramePublisher>(
        LinkFrames(configuration.robot_description, configuration.driver.joints),
        configuration.node.tf_demand_prefix, *hardware_);
  }
  call_periodically(configuration.node);
}

void DriverNode::call_periodically(const NodeParameters& parameters) {
  commanding_.add(parameters.action_monitor_rate, [this] { action_.publish_feedback(); });
  publishing_.add(parameters.state_publish_rate, [this] { states_.publish(); });
  if (link_frames_) publishing_.add(parameters.state_publish_rate, [this] { link_frames_->publish(); });
  publishing_.add(parameters.status_publish_rate, [this] { status_.publish(); });
  publishing_.add(kDiagnosticsRate, [this] { diagnostics_.publish(); });
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
  return {[this](const hardware::GoalAnswer& answer) {
            post_to(command_queue_, [this, answer] {
              action_.goal_answered(answer);
              command_.goal_answered(answer);
            });
          },
          [this](const motion::GoalResult& result) {
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

void DriverNode::bring_up(const std::function<bool()>& running) {
  while (running()) {
    hardware_->snapshot(snapshot_);
    if (bring_up_.update(snapshot_.state)) return announce();
    ROS_INFO_STREAM_THROTTLE(5.0, "waiting for the drives: " << motion::to_string(snapshot_.state));
    command_queue_.callAvailable(kBringUpGlance);
  }
}

void DriverNode::announce() {
  action_.start();
  if (snapshot_.state == motion::GroupState::Fault) {
    ROS_ERROR_STREAM("the drives are in fault: " << snapshot_.fault);
  } else {
    ROS_INFO_STREAM("ready for goals: " << motion::to_string(snapshot_.state));
  }
}

int DriverNode::run(const std::atomic<bool>& stop) {
  const auto running = [&] { return !stop && ros::ok() && !failed_; };
  publisher_.start();
  services_.start();
  halt_.start();
  bring_up(running);
  while (running()) serve_once(command_queue_, commanding_);
  return finish();
}

int DriverNode::finish() {
  // New goals wait in the queue from here on; they are never taken.
  controls_.finish_recordings();
  if (!failed_) hardware_->shut_down(kShutdownPatience);
  // What the bus thread has said last: results of goals that the stop has ended, or why it failed.
  command_queue_.callAvailable();
  action_.reject_unanswered();
  services_.stop();
  halt_.stop();
  publisher_.stop();
  publish_queue_.callAvailable();
  if (wire_log_ && wire_log_->lost() > 0) {
    ROS_WARN_STREAM(wire_log_->lost() << " frames are missing in " << wire_log_->path());
  }
  return failed_ ? 1 : 0;
}

}  // namespace interpolated_motion::node
