#include "interpolated_motion_driver/motion/execution.h"

#include <algorithm>

#include "interpolated_motion_driver/motion/faults.h"

namespace interpolated_motion::motion {

using axis::AxisState;

namespace {

bool has_left(const axis::Axis& axis) { return axis.finished() && axis.state() == AxisState::Ready; }

}  // namespace

Execution::Execution(const GroupParameters& parameters, Drives& drives, const SpeedControl& speed,
                     Outcomes& outcomes)
    : parameters_(parameters), drives_(drives), speed_(speed), outcomes_(outcomes) {
  tracking_.desired.resize(drives.axes().size());
  tracking_.actual.resize(drives.axes().size());
}

std::optional<GoalTime> Execution::changeable_from() const {
  if (active_ && !active_->begin_is_set) return std::nullopt;
  return drives_.changeable_from();
}

// How it comes to the drives.

void Execution::begin(GoalId id, Planning& planning, HostTime now) {
  const trajectory::Goal& goal = *planning.goal;
  const double rate = planning.is_paused() ? 1.0 : planning.course.law.final_rate();
  active_ = ActiveGoal{};
  active_->id = id;
  active_->tolerances = trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, goal);
  active_->lead_in = planning.plan.lead_in;
  active_->duration = planning.plan.duration;
  active_->end = planning.end;
  active_->start = goal.start ? *goal.start - host_duration(planning.plan.lead_in.count() / rate) : now;
  load(planning, now);
}

void Execution::join(GoalId id, Planning& planning, HostTime now) {
  active_ = ActiveGoal{};
  active_->id = id;
  active_->tolerances =
      trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, *planning.goal);
  active_->lead_in = planning.plan.lead_in;
  active_->duration = planning.plan.duration;
  active_->zero = planning.joining.course.law.at(planning.joining.join).nominal + active_->lead_in;
  active_->end = planning.end;
  active_->lingers = true;
  active_->speeds = planning.premises.speeds;
  active_->begin_is_set = true;
  drives_.set_last({id, active_->lead_in + active_->duration});
  drives_.follow(std::move(planning.course), std::move(planning.tails), now);
  drives_.enter(GroupState::Moving);
}

void Execution::go_on(Planning& planning, HostTime now) {
  if (planning.entry != Planning::Entry::Join) return load(planning, now);
  active_->speeds = planning.premises.speeds;
  active_->lingers = true;
  drives_.follow(std::move(planning.course), std::move(planning.tails), now);
}

void Execution::load(Planning& planning, HostTime now) {
  active_->course = std::move(planning.course);
  active_->speeds = planning.premises.speeds;
  active_->begin_is_set = false;
  active_->lingers = false;
  if (planning.is_paused()) return;
  active_->start = std::max(active_->start, now);
  active_->set_out = active_->start - host_duration(head_start(drives_.axes()).count());
  drives_.load(std::move(planning.tails), now);
  drives_.enter(GroupState::Preparing);
}

void Execution::start_motion(HostTime now) {
  for (axis::Axis* axis : drives_.axes()) {
    if (begins_at_signal(*axis)) axis->arm(now, now);
  }
  signal_all(drives_.signals(), now);
  set_common_begin(now);
  drives_.begin(std::exchange(active_->course, TimedPaths{}),
                {active_->id, active_->lead_in + active_->duration}, now);
  drives_.enter(GroupState::Moving);
}

/// Tells the axes that need a lead when to begin: when those do that have got the start signal.
void Execution::set_common_begin(HostTime now) {
  const Axes& axes = drives_.axes();
  HostTime begin = std::max(active_->start, now + host_duration(longest_lead(axes).count()));
  if (std::any_of(axes.begin(), axes.end(), [](const axis::Axis* a) { return begins_at_signal(*a); })) {
    begin = HostTime::min();
    for (const axis::Axis* axis : axes) {
      if (begins_at_signal(*axis)) begin = std::max(begin, axis->path_begin());
    }
    if (begin == kNever) return;
  }
  for (axis::Axis* axis : axes) {
    if (!begins_at_signal(*axis)) axis->arm(begin, now);
  }
  active_->begin_is_set = true;
}

// While it is executed.

void Execution::poll(bool is_replaced, HostTime now) {
  if (const axis::Axis* axis = find_faulted(drives_.axes())) return abort_with_fault_of(*axis, now);
  switch (drives_.state()) {
    case GroupState::Preparing:
      return poll_preparing(now);
    case GroupState::Moving:
      return poll_moving(is_replaced, now);
    default:
      return poll_settling(is_replaced, now);
  }
}

void Execution::poll_preparing(HostTime now) {
  if (speed_.is_paused()) return;
  if (all_are(drives_.axes(), AxisState::Loaded) && now >= active_->set_out) start_motion(now);
}

void Execution::poll_moving(bool is_replaced, HostTime now) {
  if (!active_->begin_is_set) set_common_begin(now);
  if (auto violation = find_violation(false)) return stop({GoalOutcome::Aborted, *violation}, now);
  const bool stops = stops_on_way();
  const bool lingers = active_->lingers && (!stops || active_->ending);
  const GoalTime end =
      stops ? drives_.course().law().steady_from() : *drives_.course().law().when(active_->end);
  const auto played = [now, lingers, end](const axis::Axis* axis) {
    return has_left(*axis) || (lingers && axis->playback(now) >= end);
  };
  if (!std::all_of(drives_.axes().begin(), drives_.axes().end(), played)) return;
  if (stops || active_->ending) return rest_on_path(is_replaced, now);
  active_->ended = now;
  drives_.enter(GroupState::Settling);
}

void Execution::poll_settling(bool is_replaced, HostTime now) {
  if (is_replaced) {
    finish(replaced_by_goal());
  } else {
    if (!have_reported_since(drives_.axes(), active_->ended)) return;
    const auto violation = find_violation(true);
    if (violation && now < active_->settle_deadline(parameters_.settle_timeout)) return;
    finish(violation ? Ending{GoalOutcome::Aborted, *violation}
                     : Ending{GoalOutcome::Succeeded, {{}, active_->remark}});
  }
  drives_.enter(GroupState::Standing);
}

HostTime Execution::next_deadline() const {
  if (!active_) return kNever;
  if (drives_.state() == GroupState::Settling) return active_->settle_deadline(parameters_.settle_timeout);
  const bool waits = drives_.state() == GroupState::Preparing && !speed_.is_paused();
  return waits && all_are(drives_.axes(), AxisState::Loaded) ? active_->set_out : kNever;
}

/// The course comes to rest before the end of the goal.
bool Execution::stops_on_way() const { return !drives_.course().law().when(active_->end); }

/// The drives stand before the goal's end: it is paused, or has been stopped.
void Execution::rest_on_path(bool is_replaced, HostTime now) {
  if (active_->ending) {
    finish({});
    outcomes_.end_stops(GoalOutcome::Succeeded);
    return drives_.enter(GroupState::Standing);
  }
  active_->course = drives_.course().timed();
  if (is_replaced) finish(replaced_by_goal());
  drives_.enter_rest_state(now);
}

// Desired and actual states belong to the instant at which each drive latched its position, on that drive's
// own clock: a delay on the bus or a slow crystal is no error of the motion.
void Execution::sample_feedback() {
  for (std::size_t i = 0; i < drives_.axes().size(); ++i) {
    const axis::AxisFeedback& feedback = drives_.axes()[i]->feedback();
    tracking_.actual[i] = {feedback.position, feedback.velocity, 0.0};
    tracking_.desired[i] = drives_.desired(i, feedback.time);
    if (drives_.plays_course() && feedback.mean_over > HostDuration{}) {
      const double before = drives_.desired(i, feedback.time - feedback.mean_over).position;
      tracking_.desired[i].velocity = (tracking_.desired[i].position - before) / seconds(feedback.mean_over);
    }
  }
}

/// Of the tolerances at the goal's end, or on its path.
std::optional<Refusal> Execution::find_violation(bool at_goal) {
  sample_feedback();
  const trajectory::Tolerances& tolerances = active_->tolerances;
  const auto violation = trajectory::find_tolerance_violation(at_goal ? tolerances.goal : tolerances.path,
                                                              tracking_.desired, tracking_.actual);
  if (!violation) return std::nullopt;
  const auto text = at_goal ? trajectory::goal_tolerance_violated : trajectory::path_tolerance_violated;
  return text(parameters_.rules.joints[violation->joint], parameters_.rules.limits[violation->joint].unit,
              *violation);
}

// How it ends.

void Execution::stop(const Ending& ending, HostTime now) {
  if (active_) ending_ = ending;
  drives_.stop(now);
}

void Execution::abort_with_fault_of(const axis::Axis& axis, HostTime now) {
  const char* others = drives_.axes().size() > 1 ? " The other joints were stopped." : "";
  const std::string text = bus_faults(drives_.signals()) + axis.fault_text() + others;
  stop({GoalOutcome::Aborted, {GoalError::InvalidGoal, text}}, now);
}

void Execution::end_stopped() {
  if (ending_) finish(*std::exchange(ending_, std::nullopt));
}

void Execution::finish(const Ending& ending) {
  if (!active_) return;
  const Ending& first = active_->ending ? *active_->ending : ending;
  outcomes_.end(active_->id, first.outcome, first.reason);
  active_.reset();
}

// What is told of it.

/// How far it has come, in nominal time of its course.
GoalTime Execution::nominal_time(HostTime now) const {
  const trajectory::TimeLaw& next = active_->course.law;
  if (drives_.state() == GroupState::Idle) return next.at(next.steady_from()).nominal;
  const bool begins = drives_.state() == GroupState::Preparing;
  const trajectory::TimeLaw& law = begins ? next : drives_.course().law();
  return law.at(drives_.axes().front()->playback(now)).nominal;
}

void Execution::fill(HostTime now, Snapshot& out) const {
  out.active_goal = active_ ? active_->id : 0;
  out.goal_time = active_ ? nominal_time(now) - active_->zero : GoalTime{0.0};
  out.goal_duration = active_ ? active_->duration : GoalTime{0.0};
  out.speed.override_rate = speed_.override_rate();
  out.speed.paused = speed_.is_paused();
  const bool moves = active_ && drives_.plays_course();
  out.speed.rate =
      moves ? drives_.course().law().at(drives_.axes().front()->playback(now)).rate : speed_.wanted().rate;
}

}  // namespace interpolated_motion::motion
