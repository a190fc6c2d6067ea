#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

namespace {

/// How long the drives rest at the begin of a stream: by then the host knows when they have begun, and sends
/// the first path.
constexpr GoalTime kTimeToJoin{1.0};

}  // namespace

std::optional<Refusal> Group::setpoint(const Setpoint& setpoint, HostTime now) {
  auto refusal = take_setpoint(setpoint, now);
  ++(refusal ? setpoints_.refused : setpoints_.accepted);
  return refusal;
}

std::optional<Refusal> Group::take_setpoint(const Setpoint& setpoint, HostTime now) {
  if (auto refusal = refuse_now()) return refusal;
  if (state_ == GroupState::Idle) return open_stream(setpoint, now);
  if (state_ != GroupState::Streaming)
    return Refusal{GoalError::InvalidGoal, "A goal is under way. Setpoints are taken when it has ended."};
  if (auto refusal = stream_.check(setpoint, now)) return refusal;
  if (stream_stage_ == StreamStage::Following) return follow_stream(setpoint);
  wait_with(setpoint);
  return std::nullopt;
}

/// The drives are set going at rest; the first setpoint waits until they have begun.
std::optional<Refusal> Group::open_stream(const Setpoint& setpoint, HostTime now) {
  std::vector<double> rest;
  GoalTime lead{0.0};
  for (const axis::Axis* axis : axes_) {
    rest.push_back(axis->rest_position());
    lead = std::max(lead, axis->stream_lead());
  }
  stream_.begin(rest, lead, now);
  if (auto refusal = stream_.check(setpoint, now)) return refusal;
  if (auto way = stream_.way_to(setpoint, now); !way) return way.error();
  for (axis::Axis* axis : axes_) {
    if (auto refusal = axis->plan_stream(now, longest_lead() + kTimeToJoin)) return refusal;
  }
  stream_.take(setpoint);
  waiting_ = setpoint;
  for (axis::Axis* axis : axes_) axis->load(now);
  stream_stage_ = StreamStage::Loading;
  last_is_stream_ = true;
  in_force_since_ = now;
  enter(GroupState::Streaming);
  return std::nullopt;
}

void Group::wait_with(const Setpoint& setpoint) {
  if (waiting_) stream_.pass_over(*waiting_);
  stream_.take(setpoint);
  waiting_ = setpoint;
}

std::optional<Refusal> Group::follow_stream(const Setpoint& setpoint) {
  const HostTime committed = this->committed();
  if (committed == kNever) {
    return Refusal{
        GoalError::InvalidGoal,
        "The stream has paused for so long that its end is in the drives already. Send on: the next "
        "stream begins when they are at rest."};
  }
  auto paths = stream_.way_to(setpoint, committed);
  if (!paths) return paths.error();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (auto refusal = axes_[i]->plan_follow(paths.value()[i])) return refusal;
  }
  stream_.take(setpoint);
  stream_.follow(setpoint, std::move(paths.value()));
  for (axis::Axis* axis : axes_) axis->follow();
  return std::nullopt;
}

/// Until when the motion of any drive can no longer be changed.
HostTime Group::committed() const {
  HostTime committed = HostTime::min();
  for (const axis::Axis* axis : axes_) committed = std::max(committed, axis->committed());
  return committed;
}

// The stream ends by itself: the path behind its last setpoint comes to rest.
void Group::poll_streaming(HostTime now) {
  if (const axis::Axis* axis = faulted()) return abort_with_fault_of(*axis, now);
  if (stream_stage_ == StreamStage::Loading) {
    if (all(axis::AxisState::Loaded)) begin_stream(now);
    return;
  }
  if (stream_stage_ == StreamStage::Beginning && committed() != kNever) join_stream();
  if (all(axis::AxisState::Ready)) enter_rest_state(now);
}

void Group::begin_stream(HostTime now) {
  const HostTime begin = now + host_duration(longest_lead().count());
  for (axis::Axis* axis : axes_) axis->arm(begin, now);
  signal_all(now);
  stream_stage_ = StreamStage::Beginning;
}

// A setpoint that cannot be reached from here is passed over as one that has been lost: the next one may do.
void Group::join_stream() {
  stream_stage_ = StreamStage::Following;
  if (!waiting_) return;
  const Setpoint setpoint = *std::exchange(waiting_, std::nullopt);
  if (!follow_stream(setpoint)) return;
  stream_.pass_over(setpoint);
  --setpoints_.accepted;
  ++setpoints_.refused;
}

}  // namespace interpolated_motion::motion
