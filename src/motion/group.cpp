#include "interpolated_motion_driver/motion/group.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/faults.h"

namespace interpolated_motion::motion {

using axis::AxisState;

namespace {

/// The axis works towards nothing: it waits for a command.
bool is_settled(const axis::Axis& axis) {
  return axis.state() == AxisState::Disabled || axis.state() == AxisState::Ready || is_out_of_order(axis);
}

/// Its power stage may be on.
bool is_powered(const axis::Axis& axis) { return axis.state() != AxisState::Disabled; }

bool all_settled(const std::vector<axis::Axis*>& axes) {
  return std::all_of(axes.begin(), axes.end(), [](const axis::Axis* axis) { return is_settled(*axis); });
}

}  // namespace

Group::Group(GroupParameters parameters, std::vector<axis::Axis*> axes,
             std::vector<axis::StartSignal*> signals, HostTime now)
    : parameters_(std::move(parameters)),
      drives_(std::move(axes), std::move(signals)),
      enable_when_found_(parameters_.enable_on_start),
      goals_(parameters_, drives_),
      stream_(parameters_, drives_) {
  for (axis::Axis* axis : drives_.axes()) axis->bring_up(now);
  drives_.enter(GroupState::Starting);
}

void Group::poll(HostTime now) {
  for (axis::Axis* axis : drives_.axes()) axis->poll(now);
  switch (drives_.state()) {
    case GroupState::Starting:
      poll_starting(now);
      break;
    case GroupState::Enabling:
      poll_enabling(now);
      break;
    case GroupState::Preparing:
    case GroupState::Moving:
    case GroupState::Settling:
      goals_.poll(now);
      if (drives_.state() == GroupState::Standing) poll_standing(now);
      break;
    case GroupState::Streaming:
      poll_streaming(now);
      break;
    case GroupState::Standing:
      poll_standing(now);
      break;
    case GroupState::Stopping:
      poll_stopping(now);
      break;
    case GroupState::Idle:
    case GroupState::Disabled:
      if (find_faulted(drives_.axes())) enter_fault();
      break;
    case GroupState::Fault:
      if (power_off_ != PowerOff::No) poll_fault(now);
      break;
  }
  // Who asked in a fault for the other drives to be switched off is answered when they are.
  if (drives_.state() != GroupState::Fault || power_off_ == PowerOff::No)
    requests_.settle(drives_.state(), fault_);
}

HostTime Group::next_deadline() const {
  HostTime next = goals_.execution().next_deadline();
  for (const axis::Axis* axis : drives_.axes()) next = std::min(next, axis->next_deadline());
  const bool replaced = drives_.state() == GroupState::Settling && goals_.has_waiting();
  const bool stands = drives_.state() == GroupState::Standing && all_are(drives_.axes(), AxisState::Ready);
  return replaced || stands ? HostTime{} : next;
}

void Group::poll_starting(HostTime now) {
  if (!all_settled(drives_.axes())) return;
  if (power_off_ != PowerOff::No) return drives_.enter(GroupState::Stopping);
  if (find_faulted(drives_.axes())) return enter_fault();
  drives_.enter_rest_state(now);
  if (enable_when_found_ && drives_.state() == GroupState::Disabled) start_enabling(now);
  enable_when_found_ = false;
}

void Group::poll_enabling(HostTime now) {
  if (find_faulted(drives_.axes())) return enter_fault();
  if (all_are(drives_.axes(), AxisState::Ready)) drives_.enter_rest_state(now);
}

// The drives leave their interpolation by themselves, at the end of their records.
void Group::poll_standing(HostTime now) {
  if (const axis::Axis* axis = find_faulted(drives_.axes()))
    return goals_.execution().abort_with_fault_of(*axis, now);
  if (all_are(drives_.axes(), AxisState::Ready)) rest(now);
}

void Group::rest(HostTime now) {
  drives_.enter_rest_state(now);
  if (goals_.has_waiting()) return stream_.forget_waiting();
  stream_.take_waiting(now);
}

void Group::poll_streaming(HostTime now) {
  if (const axis::Axis* axis = find_faulted(drives_.axes()))
    return goals_.execution().abort_with_fault_of(*axis, now);
  stream_.poll(now);
  if (drives_.state() == GroupState::Streaming && all_are(drives_.axes(), AxisState::Ready)) rest(now);
}

// Axes with a fault stop by their own reaction or are being stopped; the others have been told to. The group
// is at rest when none moves any more.
void Group::poll_stopping(HostTime now) {
  stream_.forget_waiting();
  if (!all_settled(drives_.axes())) return;
  goals_.end_stopped();
  if (power_off_ == PowerOff::Wanted) return start_disabling(now);
  power_off_ = PowerOff::No;
  if (find_faulted(drives_.axes())) return enter_fault();
  drives_.enter_rest_state(now);
  goals_.end_stops();
  requests_.settle(drives_.state(), fault_);  // before a goal that has waited for this rest begins
}

void Group::poll_fault(HostTime now) {
  const bool settled = all_settled(drives_.axes());
  if (any_is(drives_.axes(), AxisState::Ready) || (settled && power_off_ == PowerOff::Wanted))
    return start_disabling(now);
  if (settled) power_off_ = PowerOff::No;
}

void Group::start_enabling(HostTime now) {
  for (axis::Axis* axis : drives_.axes()) {
    if (axis->state() == AxisState::Disabled) axis->enable(now);
  }
  signal_all(drives_.signals(), now);
  drives_.enter(GroupState::Enabling);
}

// Drives in fault are told as well: what the host has found wrong need not have switched them off. They are
// told once, when they have come to rest.
void Group::start_disabling(HostTime now) {
  const bool settled = all_settled(drives_.axes());
  for (axis::Axis* axis : drives_.axes()) {
    if (axis->state() == AxisState::Ready || (settled && is_out_of_order(*axis))) axis->disable(now);
  }
  if (settled) power_off_ = PowerOff::Told;
  signal_all(drives_.signals(), now);
}

void Group::reset(HostTime now) {
  goals_.count_order();
  for (axis::Axis* axis : drives_.axes()) {
    if (is_faulted(*axis)) axis->reset_fault(now);
  }
  fault_.clear();
  drives_.enter(GroupState::Starting);
}

void Group::enter_fault() {
  fault_ = fault_text(drives_.axes(), drives_.signals());
  goals_.fail(fault_);
  enable_when_found_ = false;
  drives_.enter(GroupState::Fault);
}

RequestId Group::request(RequestKind kind, HostTime now) {
  const RequestId id = requests_.add(kind);
  switch (kind) {
    case RequestKind::Enable:
      if (drives_.in_motion()) requests_.finish(id, true, "all drives are enabled, and the group is moving");
      if (drives_.state() == GroupState::Disabled) start_enabling(now);
      if (drives_.state() == GroupState::Starting && power_off_ == PowerOff::No) enable_when_found_ = true;
      break;
    case RequestKind::Disable:
      disable("stopped since the drives are to be disabled", now);
      break;
    case RequestKind::ShutDown:
      disable("stopped since the driver is shutting down", now);
      break;
    case RequestKind::ResetFaults:
      if (drives_.in_motion())
        requests_.finish(id, false, "nothing is in fault, and the group is moving; nothing was changed");
      if (drives_.state() == GroupState::Fault) reset(now);
      break;
    case RequestKind::Halt:
      halt(now, "halted by a call of ~halt");
      break;
    case RequestKind::ClearBuffers:
      halt(now, "stopped by a call of ~clear_buffers");
      break;
  }
  // What is so already is said before the next order changes it.
  if (power_off_ == PowerOff::No) requests_.settle(drives_.state(), fault_);
  return id;
}

void Group::halt(HostTime now, const std::string& why) {
  goals_.halt(why, {GoalOutcome::Aborted, {GoalError::InvalidGoal, "The group was " + why + "."}}, now);
}

// Whatever the group is doing: drives that are on may be among others that are in fault, or were left on when
// those were reset.
void Group::disable(const std::string& why, HostTime now) {
  halt(now, why);
  enable_when_found_ = false;
  if (std::none_of(drives_.axes().begin(), drives_.axes().end(),
                   [](const axis::Axis* a) { return is_powered(*a); }))
    return;
  power_off_ = PowerOff::Wanted;
  if (drives_.state() == GroupState::Idle) start_disabling(now);
  if (drives_.state() == GroupState::Fault) poll_fault(now);
  if (drives_.state() != GroupState::Starting && drives_.state() != GroupState::Fault)
    drives_.enter(GroupState::Stopping);
}

}  // namespace interpolated_motion::motion
