#include "interpolated_motion_driver/node/message_conversion.h"

#include <cmath>
#include <limits>
#include <utility>

#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {
namespace {

/// A buffer that is empty at rest is as it should be, whatever the drive says of it.
bool executes_records(motion::GroupState state) {
  return state == motion::GroupState::Moving || state == motion::GroupState::Streaming;
}

trajectory::Waypoint to_waypoint(const trajectory_msgs::JointTrajectoryPoint& point) {
  return {GoalTime(point.time_from_start.toSec()), point.positions, point.velocities, point.accelerations,
          point.effort};
}

std::vector<trajectory::JointTolerance> to_tolerances(
    const std::vector<control_msgs::JointTolerance>& messages) {
  std::vector<trajectory::JointTolerance> tolerances;
  tolerances.reserve(messages.size());
  for (const auto& message : messages) {
    tolerances.push_back({message.name, message.position, message.velocity, message.acceleration});
  }
  return tolerances;
}

/// The names of the joints into any message's list, without allocation once it has grown.
template <class Names>
void fill_names(const motion::Snapshot& snapshot, Names& names) {
  names.resize(snapshot.joints.size());
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = snapshot.joints[i].joint;
}

/// One column of a table message: `value(joint)` for every joint.
template <class Column, class Value>
void fill_column(const motion::Snapshot& snapshot, Column& column, Value value) {
  column.resize(snapshot.joints.size());
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = value(snapshot.joints[i]);
}

template <class Message>
void fill_controller_state(const motion::Snapshot& snapshot, Message& message) {
  using Joint = motion::JointSnapshot;
  message.header.stamp = to_ros_time(snapshot.time);
  fill_names(snapshot, message.joint_names);
  fill_column(snapshot, message.desired.positions, [](const Joint& j) { return j.desired.position; });
  fill_column(snapshot, message.desired.velocities, [](const Joint& j) { return j.desired.velocity; });
  fill_column(snapshot, message.desired.accelerations, [](const Joint& j) { return j.desired.acceleration; });
  message.desired.time_from_start = ros::Duration(snapshot.goal_time.count());
  fill_column(snapshot, message.actual.positions, [](const Joint& j) { return j.actual.position; });
  fill_column(snapshot, message.actual.velocities, [](const Joint& j) { return j.actual.velocity; });
  fill_column(snapshot, message.error.positions,
              [](const Joint& j) { return j.desired.position - j.actual.position; });
  fill_column(snapshot, message.error.velocities,
              [](const Joint& j) { return j.desired.velocity - j.actual.velocity; });
}

double bus_load(const motion::Snapshot& snapshot, const std::string& bus) {
  for (const auto& candidate : snapshot.buses) {
    if (candidate.name == bus) return candidate.load;
  }
  return 0.0;
}

}  // namespace

trajectory::Goal to_goal(const trajectory_msgs::JointTrajectory& message) {
  trajectory::Goal goal;
  goal.joint_names = message.joint_names;
  goal.points.reserve(message.points.size());
  for (const auto& point : message.points) goal.points.push_back(to_waypoint(point));
  if (!message.header.stamp.isZero()) goal.start = to_host_time(message.header.stamp);
  return goal;
}

motion::Setpoint to_setpoint(const trajectory_msgs::JointTrajectory& message, std::string source,
                             HostTime arrived) {
  const auto& point = message.points.front();
  motion::Setpoint setpoint;
  const HostTime stamp = message.header.stamp.isZero() ? arrived : to_host_time(message.header.stamp);
  setpoint.time = stamp + host_duration(point.time_from_start.toSec());
  setpoint.joint_names = message.joint_names;
  setpoint.positions = point.positions;
  setpoint.velocities = point.velocities;
  setpoint.source = std::move(source);
  return setpoint;
}

trajectory::Goal to_goal(const control_msgs::FollowJointTrajectoryGoal& message) {
  trajectory::Goal goal = to_goal(message.trajectory);
  goal.path_tolerance = to_tolerances(message.path_tolerance);
  goal.goal_tolerance = to_tolerances(message.goal_tolerance);
  goal.goal_time_tolerance = message.goal_time_tolerance.toSec();
  return goal;
}

control_msgs::FollowJointTrajectoryResult to_result(GoalError code, const std::string& text) {
  control_msgs::FollowJointTrajectoryResult result;
  result.error_code = static_cast<std::int32_t>(code);
  result.error_string = text;
  return result;
}

control_msgs::FollowJointTrajectoryResult to_result(const motion::GoalResult& result) {
  if (result.outcome == motion::GoalOutcome::Aborted) return to_result(result.code, result.text);
  control_msgs::FollowJointTrajectoryResult message;
  message.error_code = control_msgs::FollowJointTrajectoryResult::SUCCESSFUL;
  message.error_string = result.text;
  return message;
}

void fill_state(const motion::Snapshot& snapshot, control_msgs::JointTrajectoryControllerState& message) {
  fill_controller_state(snapshot, message);
}

void fill_state(const motion::Snapshot& snapshot, control_msgs::FollowJointTrajectoryFeedback& message) {
  fill_controller_state(snapshot, message);
}

void fill_joint_state(const motion::Snapshot& snapshot, sensor_msgs::JointState& message) {
  message.header.stamp = to_ros_time(snapshot.time);
  message.name.clear();
  message.position.clear();
  message.velocity.clear();
  for (const auto& joint : snapshot.joints) {
    if (!joint.online) continue;
    message.name.push_back(joint.joint);
    message.position.push_back(joint.actual.position);
    message.velocity.push_back(joint.actual.velocity);
  }
}

void fill_buffer_status(const motion::Snapshot& snapshot, interpolated_motion_driver::BufferStatus& message) {
  using Joint = motion::JointSnapshot;
  message.header.stamp = to_ros_time(snapshot.time);
  fill_names(snapshot, message.name);
  fill_column(snapshot, message.bus, [](const Joint& j) { return j.bus; });
  fill_column(snapshot, message.capacity, [](const Joint& j) { return j.capacity; });
  fill_column(snapshot, message.fill, [](const Joint& j) { return j.fill; });
  fill_column(snapshot, message.fill_time, [](const Joint& j) { return j.fill_time; });
  const bool plays = executes_records(snapshot.state);
  fill_column(snapshot, message.underflow_warning,
              [plays](const Joint& j) { return plays && j.warnings.underflow; });
  fill_column(snapshot, message.overflow_warning, [](const Joint& j) { return j.warnings.overflow; });
  fill_column(snapshot, message.velocity_warning, [](const Joint& j) { return j.warnings.velocity; });
  fill_column(snapshot, message.acceleration_warning, [](const Joint& j) { return j.warnings.acceleration; });
  fill_column(snapshot, message.underruns, [](const Joint& j) { return j.underruns; });
  fill_column(snapshot, message.overflows, [](const Joint& j) { return j.overflows; });
  fill_column(snapshot, message.refused_writes, [](const Joint& j) { return j.refused_writes; });
  fill_column(snapshot, message.records_sent, [](const Joint& j) { return j.records_sent; });
  fill_column(snapshot, message.bus_load, [&](const Joint& j) { return bus_load(snapshot, j.bus); });
  fill_column(snapshot, message.clock_error, [](const Joint& j) { return j.clock_error_ppm; });
}

void fill_drive_states(const motion::Snapshot& snapshot, interpolated_motion_driver::DriveState& message) {
  using Joint = motion::JointSnapshot;
  message.header.stamp = to_ros_time(snapshot.time);
  fill_names(snapshot, message.name);
  fill_column(snapshot, message.unit, [](const Joint& j) { return trajectory::symbol(j.unit); });
  fill_column(snapshot, message.state, [](const Joint& j) { return j.state; });
  fill_column(snapshot, message.statusword, [](const Joint& j) { return j.statusword; });
  fill_column(snapshot, message.mode, [](const Joint& j) { return j.mode; });
  fill_column(snapshot, message.demand_position, [](const Joint& j) { return j.demand_position; });
  fill_column(snapshot, message.actual_position, [](const Joint& j) { return j.actual.position; });
  fill_column(snapshot, message.velocity, [](const Joint& j) { return j.actual.velocity; });
  fill_column(snapshot, message.following_error, [](const Joint& j) { return j.following_error; });
  fill_column(snapshot, message.error_code, [](const Joint& j) { return j.error_code; });
  fill_column(snapshot, message.error_text, [](const Joint& j) { return j.error_text; });
  fill_column(snapshot, message.online, [](const Joint& j) { return static_cast<std::uint8_t>(j.online); });
}

void fill_motion_report(const motion::MotionReport& report,
                        interpolated_motion_driver::GetMotionReport::Response& response) {
  response.valid = report.valid;
  response.duration = report.duration.count();
  for (const auto& joint : report.joints) {
    // A real drive does not tell its demand at every sample: there is nothing to compare.
    const bool compared = joint.samples > 0;
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    response.name.push_back(joint.joint);
    response.bus.push_back(joint.bus);
    response.unit.emplace_back(trajectory::symbol(joint.unit));
    response.count.push_back(joint.count);
    response.records_sent.push_back(joint.records_sent);
    response.samples.push_back(joint.samples);
    response.worst_deviation.push_back(compared ? joint.worst_deviation : kUnknown);
    response.final_deviation.push_back(compared ? joint.final_deviation : kUnknown);
    response.minimum_fill.push_back(joint.minimum_fill);
    response.underruns.push_back(joint.underruns);
    response.refused_writes.push_back(joint.refused_writes);
  }
  for (const auto& [bus, load] : report.peak_bus_load) {
    response.bus_name.push_back(bus);
    response.peak_bus_load.push_back(load);
  }
}

}  // namespace interpolated_motion::node
