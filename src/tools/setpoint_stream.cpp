#include "setpoint_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include <control_msgs/JointTrajectoryControllerState.h>
#include <fmt/format.h>
#include <interpolated_motion_driver/BufferStatus.h>
#include <interpolated_motion_driver/DriveState.h>
#include <trajectory_msgs/JointTrajectory.h>

namespace interpolated_motion::tools {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr double kPeriod = 0.02;  // s, of the setpoints
constexpr int kHeld = 25;         // setpoints at the end, all of one position
constexpr auto kPatience = std::chrono::seconds(30);

using Clock = std::chrono::steady_clock;

/// Where the arm stands, joint by joint.
struct Pose {
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< "rad" or "m"
  std::vector<double> positions;
};

/// rad, or m of a prismatic joint.
double amplitude(const std::string& unit) { return unit == "m" ? 0.02 : 0.2; }
/// Of the rest, likewise.
double tolerance(const std::string& unit) { return unit == "m" ? 1e-4 : 1e-3; }

/// Where the joints are to be `time` s after the begin of the stream at `rest`: a sine of 1 Hz, at rest then.
std::vector<double> setpoint(const Pose& rest, double time) {
  std::vector<double> positions = rest.positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] += amplitude(rest.units[i]) * (1.0 - std::cos(2.0 * kPi * time));
  return positions;
}

/// The arm as the driver reports it.
class Arm {
 public:
  Arm(ros::NodeHandle& node, const std::string& driver)
      : state_subscriber_(node.subscribe(driver + "/state", 10, &Arm::take_state, this)),
        drive_subscriber_(node.subscribe(driver + "/drive_states", 1, &Arm::take_drives, this)),
        buffer_subscriber_(node.subscribe(driver + "/buffer_status", 1, &Arm::take_buffers, this)) {}

  /// False when there is no report in time.
  bool wait(Pose& pose) {
    const auto end = Clock::now() + kPatience;
    while (ros::ok() && Clock::now() < end) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        pose = {latest_.joint_names, drives_.unit, latest_.actual.positions};
      }
      if (!pose.positions.empty() && pose.units.size() == pose.positions.size()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  /// No drive has records left to execute: the stream has ended. A drive that holds one setpoint and no more
  /// holds one at rest.
  bool buffers_are_empty() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < buffers_.fill.size(); ++i) {
      if (buffers_.capacity[i] > 1 && buffers_.fill[i] > 0) return false;
    }
    return true;
  }

 private:
  void take_state(const control_msgs::JointTrajectoryControllerState::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    latest_ = *message;
  }
  void take_drives(const interpolated_motion_driver::DriveState::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    drives_ = *message;
  }
  void take_buffers(const interpolated_motion_driver::BufferStatus::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    buffers_ = *message;
  }

  std::mutex mutex_;
  control_msgs::JointTrajectoryControllerState latest_;
  interpolated_motion_driver::DriveState drives_;
  interpolated_motion_driver::BufferStatus buffers_;
  ros::Subscriber state_subscriber_;
  ros::Subscriber drive_subscriber_;
  ros::Subscriber buffer_subscriber_;
};

int last_of(const StreamOptions& options) {
  return static_cast<int>(std::lround(options.duration / kPeriod));
}

/// Sends the setpoints, each at its time and up to half a period later, and holds the last position. Returns
/// how many were sent.
int send(const ros::Publisher& publisher, const StreamOptions& options, const Pose& rest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int last = last_of(options);
  const auto begin = Clock::now();
  const ros::Time stamp = ros::Time::now();
  int sent = 0;
  for (int k = 0; k < last + kHeld && ros::ok(); ++k) {
    const bool lost = unit(random) < options.lost;
    const double late = unit(random) * kPeriod / 2.0;
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(k * kPeriod + late)));
    if (k % 50 == 0) {
      std::fputs(
          fmt::format("{:.0f} of {:.0f} s, {} setpoints sent\n", k * kPeriod, options.duration, sent).c_str(),
          stdout);
      std::fflush(stdout);
    }
    if (publisher.getNumSubscribers() == 0)
      break;  // the next driver of that name is not the one that was asked
    if (lost) continue;
    trajectory_msgs::JointTrajectory message;
    message.header.stamp = stamp + ros::Duration(k * kPeriod);
    message.joint_names = rest.names;
    message.points.resize(1);
    message.points[0].positions = setpoint(rest, std::min(k, last) * kPeriod);
    publisher.publish(message);
    ++sent;
  }
  return sent;
}

/// What speaks against the stream having ended within the tolerance of `goal`; empty when nothing does.
std::string what_is_off(Arm& arm, const std::vector<double>& goal) {
  Pose pose;
  if (!arm.wait(pose)) return "No state of the arm has come.\n";
  std::string off;
  for (std::size_t i = 0; i < goal.size(); ++i) {
    const double error = pose.positions[i] - goal[i];
    if (std::abs(error) > tolerance(pose.units[i]))
      off += fmt::format("{} is {:.5f} {} off. ", pose.names[i], error, pose.units[i]);
  }
  if (!off.empty()) return off + "Were setpoints refused? The driver's log says why.\n";
  return arm.buffers_are_empty() ? "" : "The stream has not ended: there are records left in the drives.\n";
}

/// Waits until the stream has ended, within the tolerance of `goal`; prints what speaks against it in the
/// end.
bool comes_to_rest(Arm& arm, const std::vector<double>& goal) {
  const auto end = Clock::now() + kPatience;
  std::string off;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    off = what_is_off(arm, goal);
  } while (!off.empty() && ros::ok() && Clock::now() < end);
  std::fputs(off.c_str(), stdout);
  return off.empty();
}

}  // namespace

bool stream_setpoints(ros::NodeHandle& ros_node, const StreamOptions& options) {
  Arm arm(ros_node, options.node);
  const auto publisher =
      ros_node.advertise<trajectory_msgs::JointTrajectory>(options.node + "/setpoints", 50);
  Pose rest;
  if (!arm.wait(rest)) {
    std::fputs(fmt::format("no message on {0}/state or {0}/drive_states\n", options.node).c_str(), stdout);
    return false;
  }
  for (int i = 0; i < 100 && publisher.getNumSubscribers() == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const int sent = send(publisher, options, rest);
  if (publisher.getNumSubscribers() == 0) {
    std::fputs(fmt::format("{} no longer takes setpoints: the driver has ended\n", options.node).c_str(),
               stdout);
    return false;
  }
  std::fputs(fmt::format("{} setpoints sent, {} lost\n", sent, last_of(options) + kHeld - sent).c_str(),
             stdout);
  return comes_to_rest(arm, setpoint(rest, last_of(options) * kPeriod));
}

}  // namespace interpolated_motion::tools
