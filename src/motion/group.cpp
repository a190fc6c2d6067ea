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

bool holds_motion(AxisState state) {
  return state == AxisState::Loading || state == AxisState::Loaded || state == AxisState::Moving;
}

}  // namespace

Group::Group(GroupParameters parameters, std::vector<axis::Axis*> axes,
             std::vector<axis::StartSignal*> signals, HostTime now)
    : parameters_(std::move(parameters)),
      axes_(std::move(axes)),
      signals_(std::move(signals)),
      enable_when_found_(parameters_.enable_on_start),
      stream_{SetpointPath(parameters_.rules, parameters_.stream)} {
  tracking_.desired.resize(axes_.size());
  tracking_.actual.resize(axes_.size());
  for (axis::Axis* axis : axes_) axis->bring_up(now);
  enter(GroupState::Starting);
}

void Group::poll(HostTime now) {
  for (axis::Axis* axis : axes_) axis->poll(now);
  switch (state_) {
    case GroupState::Starting:
      poll_starting(now);
      break;
    case GroupState::Enabling:
      poll_enabling(now);
      break;
    case GroupState::Preparing:
      poll_preparing(now);
      break;
    case GroupState::Moving:
      poll_moving(now);
      break;
    case GroupState::Settling:
      poll_settling(now);
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
      if (find_faulted(axes_)) enter_fault();
      break;
    case GroupState::Fault:
      if (power_off_ != PowerOff::No) poll_fault(now);
      break;
  }
  // Who asked in a fault for the other drives to be switched off is answered when they are.
  if (state_ != GroupState::Fault || power_off_ == PowerOff::No) requests_.settle(state_, fault_);
}

HostTime Group::next_deadline() const {
  HostTime next = kNever;
  for (const axis::Axis* axis : axes_) next = std::min(next, axis->next_deadline());
  if (state_ == GroupState::Preparing && active_ && all_are(axes_, AxisState::Loaded))
    next = std::min(next, active_->set_out);
  if (state_ == GroupState::Settling && active_)
    next = std::min(next, active_->settle_deadline(parameters_.settle_timeout));
  const bool replaced = state_ == GroupState::Settling && pending_;
  if (replaced || (state_ == GroupState::Standing && all_are(axes_, AxisState::Ready))) return HostTime{};
  return next;
}

void Group::poll_starting(HostTime now) {
  if (!all_settled(axes_)) return;
  if (power_off_ != PowerOff::No) return enter(GroupState::Stopping);
  if (find_faulted(axes_)) return enter_fault();
  enter_rest_state(now);
  if (enable_when_found_ && state_ == GroupState::Disabled) start_enabling(now);
  enable_when_found_ = false;
}

void Group::poll_enabling(HostTime now) {
  if (find_faulted(axes_)) return enter_fault();
  if (all_are(axes_, AxisState::Ready)) enter_rest_state(now);
}

void Group::poll_preparing(HostTime now) {
  if (const axis::Axis* axis = find_faulted(axes_)) return abort_with_fault_of(*axis, now);
  if (all_are(axes_, AxisState::Loaded) && now >= active_->set_out) start_motion(now);
}

void Group::poll_moving(HostTime now) {
  if (const axis::Axis* axis = find_faulted(axes_)) return abort_with_fault_of(*axis, now);
  if (!active_->begin_is_set) set_common_begin(now);
  if (auto violation = find_violation(false)) return stop(now, {GoalOutcome::Aborted, *violation});
  const auto played = [this, now](const axis::Axis* a) {
    if (a->finished() && a->state() == AxisState::Ready) return true;
    return active_->end && a->playback(now) >= *active_->end;
  };
  if (!std::all_of(axes_.begin(), axes_.end(), played)) return;
  active_->ended = now;
  enter(GroupState::Settling);
}

void Group::poll_settling(HostTime now) {
  if (const axis::Axis* axis = find_faulted(axes_)) return abort_with_fault_of(*axis, now);
  if (pending_) {
    finish_goal({GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  } else {
    if (!have_reported_since(axes_, active_->ended)) return;
    const auto violation = find_violation(true);
    if (violation && now < active_->settle_deadline(parameters_.settle_timeout)) return;
    finish_goal(violation ? Ending{GoalOutcome::Aborted, *violation}
                          : Ending{GoalOutcome::Succeeded, {{}, active_->remark}});
  }
  enter(GroupState::Standing);
  poll_standing(now);
}

// The drives leave their interpolation by themselves, at the end of their records.
void Group::poll_standing(HostTime now) {
  if (const axis::Axis* axis = find_faulted(axes_)) return abort_with_fault_of(*axis, now);
  if (all_are(axes_, AxisState::Ready)) rest(now);
}

void Group::rest(HostTime now) {
  enter_rest_state(now);
  std::optional<Setpoint> setpoint = std::exchange(stream_.waiting, std::nullopt);
  if (pending_ || !setpoint || state_ != GroupState::Idle) return;
  setpoint->time = now;  // as it has waited for the drives, not for its sender
  open_stream(*setpoint, now);
}

// Axes with a fault stop by their own reaction or are being stopped; the others have been told to. The group
// is at rest when none moves any more.
void Group::poll_stopping(HostTime now) {
  if (!all_settled(axes_)) return;
  if (ending_) finish_goal(*std::exchange(ending_, std::nullopt));
  if (power_off_ == PowerOff::Wanted) return start_disabling(now);
  power_off_ = PowerOff::No;
  if (find_faulted(axes_)) {
    fail_pending(fault_text(axes_, signals_));
    finish_stop_goals(GoalOutcome::Aborted, fault_text(axes_, signals_));
    return enter_fault();
  }
  enter_rest_state(now);
  finish_stop_goals(GoalOutcome::Succeeded);
  requests_.settle(state_, fault_);  // before a goal that has waited for this rest begins
}

void Group::poll_fault(HostTime now) {
  const bool settled = all_settled(axes_);
  if (any_is(axes_, AxisState::Ready) || (settled && power_off_ == PowerOff::Wanted))
    return start_disabling(now);
  if (settled) power_off_ = PowerOff::No;
}

void Group::start_enabling(HostTime now) {
  for (axis::Axis* axis : axes_) {
    if (axis->state() == AxisState::Disabled) axis->enable(now);
  }
  signal_all(signals_, now);
  enter(GroupState::Enabling);
}

// Drives in fault are told as well: what the host has found wrong need not have switched them off. They are
// told once, when they have come to rest.
void Group::start_disabling(HostTime now) {
  const bool settled = all_settled(axes_);
  for (axis::Axis* axis : axes_) {
    if (axis->state() == AxisState::Ready || (settled && is_out_of_order(*axis))) axis->disable(now);
  }
  if (settled) power_off_ = PowerOff::Told;
  signal_all(signals_, now);
}

void Group::reset(HostTime now) {
  ++premises_.orders;
  for (axis::Axis* axis : axes_) {
    if (is_faulted(*axis)) axis->reset_fault(now);
  }
  enter(GroupState::Starting);
}

void Group::enter(GroupState state) {
  state_ = state;
  ++premises_.states;
  if (state != GroupState::Fault) fault_.clear();
}

void Group::enter_rest_state(HostTime now) {
  enter(all_are(axes_, AxisState::Ready) ? GroupState::Idle : GroupState::Disabled);
  in_force_since_ = state_ == GroupState::Idle ? now : kNever;
}

void Group::enter_fault() {
  fault_ = fault_text(axes_, signals_);
  fail_pending(fault_);
  enable_when_found_ = false;
  enter(GroupState::Fault);
  in_force_since_ = kNever;
}

void Group::stop(HostTime now, Ending ending) {
  stream_.waiting.reset();
  if (active_) ending_ = std::move(ending);
  for (axis::Axis* axis : axes_) {
    if (holds_motion(axis->state())) axis->stop(now);
  }
  signal_all(signals_, now);
  enter(GroupState::Stopping);
}

void Group::abort_with_fault_of(const axis::Axis& axis, HostTime now) {
  const char* others = axes_.size() > 1 ? " The other joints were stopped." : "";
  stop(now,
       {GoalOutcome::Aborted, {GoalError::InvalidGoal, bus_faults(signals_) + axis.fault_text() + others}});
}

RequestId Group::request(RequestKind kind, HostTime now) {
  const RequestId id = requests_.add(kind);
  switch (kind) {
    case RequestKind::Enable:
      if (in_motion()) requests_.finish(id, true, "all drives are enabled, and the group is moving");
      if (state_ == GroupState::Disabled) start_enabling(now);
      if (state_ == GroupState::Starting && power_off_ == PowerOff::No) enable_when_found_ = true;
      break;
    case RequestKind::Disable:
      disable("stopped since the drives are to be disabled", now);
      break;
    case RequestKind::ShutDown:
      disable("stopped since the driver is shutting down", now);
      break;
    case RequestKind::ResetFaults:
      if (in_motion())
        requests_.finish(id, false, "nothing is in fault, and the group is moving; nothing was changed");
      if (state_ == GroupState::Fault) reset(now);
      break;
    case RequestKind::Halt:
      halt(now, "halted by a call of ~halt");
      break;
    case RequestKind::ClearBuffers:
      halt(now, "stopped by a call of ~clear_buffers");
      break;
  }
  // What is so already is said before the next order changes it.
  if (power_off_ == PowerOff::No) requests_.settle(state_, fault_);
  return id;
}

void Group::halt(HostTime now, const std::string& why) {
  ++premises_.orders;
  if (pending_) fail_pending(why);
  if (in_motion()) stop(now, {GoalOutcome::Aborted, {GoalError::InvalidGoal, "The group was " + why + "."}});
}

// Whatever the group is doing: drives that are on may be among others that are in fault, or were left on when
// those were reset.
void Group::disable(const std::string& why, HostTime now) {
  halt(now, why);
  enable_when_found_ = false;
  if (std::none_of(axes_.begin(), axes_.end(), [](const axis::Axis* a) { return is_powered(*a); })) return;
  power_off_ = PowerOff::Wanted;
  if (state_ == GroupState::Idle) start_disabling(now);
  if (state_ == GroupState::Fault) poll_fault(now);
  if (state_ != GroupState::Starting && state_ != GroupState::Fault) enter(GroupState::Stopping);
}

/// The drives play the course, or have just done so.
bool Group::plays_course() const {
  return state_ == GroupState::Moving || state_ == GroupState::Settling || state_ == GroupState::Streaming ||
         state_ == GroupState::Standing;
}

bool Group::in_motion() const { return state_ == GroupState::Preparing || plays_course(); }

}  // namespace interpolated_motion::motion
