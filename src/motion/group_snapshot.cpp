#include <utility>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

const char* to_string(GroupState state) {
  switch (state) {
    case GroupState::Starting:
      return "starting";
    case GroupState::Disabled:
      return "disabled";
    case GroupState::Enabling:
      return "enabling";
    case GroupState::Idle:
      return "idle";
    case GroupState::Preparing:
      return "preparing";
    case GroupState::Moving:
      return "moving";
    case GroupState::Settling:
      return "settling";
    case GroupState::Streaming:
      return "streaming";
    case GroupState::Standing:
      return "standing";
    case GroupState::Stopping:
      return "stopping";
    case GroupState::Fault:
      return "fault";
  }
  return "unknown";
}

namespace {

void copy_status(const axis::AxisStatus& from, JointSnapshot& to) {
  to.online = from.online;
  to.state = from.state;
  to.statusword = from.statusword;
  to.mode = from.mode;
  to.demand_position = from.demand_position;
  to.following_error = from.following_error;
  to.error_code = from.error_code;
  to.error_text = from.error_text;
  to.capacity = from.capacity;
  to.fill = from.fill;
  to.fill_time = from.fill_time;
  to.warnings.underflow = from.underflow_warning;
  to.warnings.overflow = from.overflow_warning;
  to.warnings.velocity = from.velocity_warning;
  to.warnings.acceleration = from.acceleration_warning;
  to.underruns = from.underruns;
  to.overflows = from.overflows;
  to.refused_writes = from.refused_writes;
  to.records_sent = from.records_sent;
  to.clock_error_ppm = from.clock_error_ppm;
}

}  // namespace

void Group::snapshot(HostTime now, Snapshot& out) const {
  const Axes& axes = drives_.axes();
  out.time = now;
  out.state = drives_.state();
  out.fault = fault_;
  goals_.execution().fill(now, out);
  out.setpoints = stream_.counters();
  out.joints.resize(axes.size());
  axis::AxisStatus status;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    JointSnapshot& joint = out.joints[i];
    const axis::AxisFeedback& feedback = axes[i]->feedback();
    joint.joint = axes[i]->joint();
    joint.bus = axes[i]->bus();
    joint.unit = parameters_.rules.limits[i].unit;
    joint.actual = {feedback.position, feedback.velocity, 0.0};
    joint.desired = drives_.desired(i, feedback.time);
    axes[i]->status(now, status);
    copy_status(status, joint);
  }
}

MotionReport Group::report() const {
  const Axes& axes = drives_.axes();
  const auto& last = drives_.last();
  MotionReport report;
  if (!last) return report;
  report.valid = true;
  report.goal = last->goal;
  report.duration = last->duration;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const axis::AxisReport figures = axes[i]->report();
    JointReport joint;
    joint.joint = axes[i]->joint();
    joint.bus = axes[i]->bus();
    joint.unit = parameters_.rules.limits[i].unit;
    joint.records_sent = figures.records_sent;
    joint.minimum_fill = figures.minimum_fill;
    joint.underruns = figures.underruns;
    joint.refused_writes = figures.refused_writes;
    report.joints.push_back(std::move(joint));
  }
  return report;
}

}  // namespace interpolated_motion::motion
