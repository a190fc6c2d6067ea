#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/faults.h"
#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

namespace {

/// How long the drives rest at the begin of a stream: by then the host knows when they have begun, and sends
/// the first path.
constexpr GoalTime kTimeToJoin{1.0};

SetpointPath::DemandChecks demand_checks(const std::vector<axis::Axis*>& axes) {
  SetpointPath::DemandChecks checks;
  checks.reserve(axes.size());
  for (const axis::Axis* axis : axes) checks.push_back(axis->demand_check());
  return checks;
}

}  // namespace

std::optional<Refusal> Group::setpoint(const Setpoint& setpoint, HostTime now) {
  auto refusal = take_setpoint(setpoint, now);
  ++(refusal ? stream_.counters.refused : stream_.counters.accepted);
  return refusal;
}

std::optional<Refusal> Group::take_setpoint(const Setpoint& setpoint, HostTime now) {
  if (auto refusal = refuse_now()) return refusal;
  if (holding_ || pending_)
    return Refusal{GoalError::InvalidGoal,
                   "A goal is about to begin. Setpoints are taken when it has ended."};
  if (state_ == GroupState::Idle) return open_stream(setpoint, now);
  if (state_ == GroupState::Standing) return go_on_with_stream(setpoint, now);
  if (state_ != GroupState::Streaming)
    return Refusal{GoalError::InvalidGoal, "A goal is under way. Setpoints are taken when it has ended."};
  if (auto refusal = stream_.path.check(setpoint, now)) return refusal;
  if (stream_.stage == StreamStage::Following) return follow_stream(setpoint, now);
  if (stream_.waiting) stream_.path.note(*stream_.waiting);
  stream_.path.take(setpoint);
  stream_.waiting = setpoint;
  return std::nullopt;
}

/// The drives are set going at rest; the first setpoint waits until they have begun.
std::optional<Refusal> Group::open_stream(const Setpoint& setpoint, HostTime now) {
  const std::vector<trajectory::State> rest = rest_states(axes_);
  stream_.path.begin(now, longest_stream_lead(axes_));
  if (auto refusal = stream_.path.check(setpoint, now)) return refusal;
  if (auto way = stream_.path.way_to(setpoint, GoalTime{0.0}, rest); !way) return way.error();
  std::vector<axis::TailPtr> tails;
  for (const axis::Axis* axis : axes_) {
    auto tail = axis->standing_tail(now, longest_lead(axes_) + kTimeToJoin);
    if (!tail) return tail.error();
    tails.push_back(std::move(tail.value()));
  }
  stream_.path.take(setpoint);
  stream_.waiting = setpoint;
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->load(std::move(tails[i]), now);
  std::vector<trajectory::Path> paths;
  paths.reserve(rest.size());
  for (const trajectory::State& state : rest) paths.emplace_back(state.position);
  course_.begin(std::move(paths));
  stream_.stage = StreamStage::Loading;
  last_ = LastMotion{};
  in_force_since_ = now;
  enter(GroupState::Streaming);
  return std::nullopt;
}

/// The drives stand, and are still under way. Once they have their end the newest setpoint waits for it.
std::optional<Refusal> Group::go_on_with_stream(const Setpoint& setpoint, HostTime now) {
  stream_.path.begin(now - host_duration(axes_.front()->playback(now).count()), longest_stream_lead(axes_));
  if (auto refusal = stream_.path.check(setpoint, now)) return refusal;
  if (!changeable_from()) {
    stream_.waiting = setpoint;
    return std::nullopt;
  }
  if (auto refusal = follow_stream(setpoint, now)) return refusal;
  stream_.stage = StreamStage::Following;
  last_ = LastMotion{};
  enter(GroupState::Streaming);
  return std::nullopt;
}

std::optional<Refusal> Group::follow_stream(const Setpoint& setpoint, HostTime now) {
  const std::optional<GoalTime> join = committed(axes_);
  if (!join || *join == axis::kEndCommitted) {
    return Refusal{
        GoalError::InvalidGoal,
        "The stream has paused for so long that its end is in the drives already. Send on: the next "
        "stream begins when they are at rest."};
  }
  auto way = stream_.path.way_to(setpoint, *join, course_.at(*join), demand_checks(axes_));
  if (!way) return way.error();
  const GoalTime kept = oldest_playback(axes_, now) - kKept;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    way.value()[i] = course_.joined(i, kept, *join, way.value()[i]);
  auto tails = encode_ways_on(axes_, way.value(), axis::Pace::Stream);
  if (!tails) return tails.error();
  stream_.path.take(setpoint);
  stream_.path.note(setpoint);
  follow(std::move(way.value()), std::move(tails.value()));
  return std::nullopt;
}

// The stream ends by itself: the path behind its last setpoint comes to rest.
void Group::poll_streaming(HostTime now) {
  if (const axis::Axis* axis = find_faulted(axes_)) return abort_with_fault_of(*axis, now);
  if (stream_.stage == StreamStage::Loading) {
    if (all_are(axes_, axis::AxisState::Loaded)) begin_stream(now);
    return;
  }
  if (stream_.stage == StreamStage::Beginning && committed(axes_)) join_stream(now);
  if (all_are(axes_, axis::AxisState::Ready)) rest(now);
}

void Group::begin_stream(HostTime now) {
  const HostTime begin = now + host_duration(longest_lead(axes_).count());
  for (axis::Axis* axis : axes_) axis->arm(begin, now);
  signal_all(signals_, now);
  stream_.stage = StreamStage::Beginning;
}

// A setpoint that cannot be reached from here is passed over as one that has been lost: the next one may do.
void Group::join_stream(HostTime now) {
  stream_.stage = StreamStage::Following;
  if (!stream_.waiting) return;
  const Setpoint setpoint = *std::exchange(stream_.waiting, std::nullopt);
  if (!follow_stream(setpoint, now)) return;
  stream_.path.note(setpoint);
  --stream_.counters.accepted;
  ++stream_.counters.refused;
}

}  // namespace interpolated_motion::motion
