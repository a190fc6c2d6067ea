#include "interpolated_motion_driver/motion/stream.h"

#include <utility>
#include <vector>

#include "interpolated_motion_driver/motion/axes.h"

namespace interpolated_motion::motion {

using axis::AxisState;

namespace {

/// How long the drives rest at the begin of a stream: by then the host knows when they have begun, and sends
/// the first path.
constexpr GoalTime kTimeToJoin{1.0};

SetpointPath::DemandChecks demand_checks(const Axes& axes) {
  SetpointPath::DemandChecks checks;
  checks.reserve(axes.size());
  for (const axis::Axis* axis : axes) checks.push_back(axis->demand_check());
  return checks;
}

/// In the report a stream has neither a goal nor a duration.
constexpr LastMotion kStream{};

}  // namespace

Stream::Stream(const GroupParameters& parameters, Drives& drives)
    : drives_(drives), path_(parameters.rules, parameters.stream) {}

std::optional<Refusal> Stream::take(const Setpoint& setpoint, HostTime now) {
  auto refusal = place(setpoint, now);
  ++(refusal ? counters_.refused : counters_.accepted);
  return refusal;
}

std::optional<Refusal> Stream::place(const Setpoint& setpoint, HostTime now) {
  if (drives_.state() == GroupState::Idle) return open(setpoint, now);
  if (drives_.state() == GroupState::Standing) return go_on(setpoint, now);
  if (drives_.state() != GroupState::Streaming)
    return Refusal{GoalError::InvalidGoal, "A goal is under way. Setpoints are taken when it has ended."};
  if (auto refusal = path_.check(setpoint, now)) return refusal;
  if (stage_ == Stage::Following) return follow(setpoint, now);
  if (waiting_) path_.note(*waiting_);
  path_.take(setpoint);
  waiting_ = setpoint;
  return std::nullopt;
}

/// The drives are set going at rest; the first setpoint waits until they have begun.
std::optional<Refusal> Stream::open(const Setpoint& setpoint, HostTime now) {
  const Axes& axes = drives_.axes();
  const std::vector<trajectory::State> rest = rest_states(axes);
  path_.begin(now, longest_stream_lead(axes));
  if (auto refusal = path_.check(setpoint, now)) return refusal;
  if (auto way = path_.way_to(setpoint, GoalTime{0.0}, rest); !way) return way.error();
  std::vector<axis::TailPtr> tails;
  for (const axis::Axis* axis : axes) {
    auto tail = axis->standing_tail(now, longest_lead(axes) + kTimeToJoin);
    if (!tail) return tail.error();
    tails.push_back(std::move(tail.value()));
  }
  path_.take(setpoint);
  waiting_ = setpoint;
  drives_.load(std::move(tails), now);
  std::vector<trajectory::Path> paths;
  paths.reserve(rest.size());
  for (const trajectory::State& state : rest) paths.emplace_back(state.position);
  drives_.begin(at_own_speed(std::move(paths)), kStream, now);
  stage_ = Stage::Loading;
  drives_.enter(GroupState::Streaming);
  return std::nullopt;
}

/// The drives stand, and are still under way. Once they have their end the newest setpoint waits for it.
std::optional<Refusal> Stream::go_on(const Setpoint& setpoint, HostTime now) {
  const HostTime origin = now - host_duration(drives_.axes().front()->playback(now).count());
  path_.begin(origin, longest_stream_lead(drives_.axes()));
  if (auto refusal = path_.check(setpoint, now)) return refusal;
  if (!drives_.changeable_from()) {
    waiting_ = setpoint;
    return std::nullopt;
  }
  if (auto refusal = follow(setpoint, now)) return refusal;
  stage_ = Stage::Following;
  drives_.set_last(kStream);
  drives_.enter(GroupState::Streaming);
  return std::nullopt;
}

std::optional<Refusal> Stream::follow(const Setpoint& setpoint, HostTime now) {
  const Axes& axes = drives_.axes();
  const Course& course = drives_.course();
  const std::optional<GoalTime> join = committed(axes);
  if (!join || *join == axis::kEndCommitted) {
    return Refusal{
        GoalError::InvalidGoal,
        "The stream has paused for so long that its end is in the drives already. Send on: the next "
        "stream begins when they are at rest."};
  }
  auto way = path_.way_to(setpoint, *join, course.at(*join), demand_checks(axes));
  if (!way) return way.error();
  const GoalTime kept = oldest_playback(axes, now) - kKept;
  for (std::size_t i = 0; i < axes.size(); ++i)
    way.value()[i] = course.joined(i, kept, *join, way.value()[i]);
  auto tails = encode_ways_on(axes, way.value(), axis::Pace::Stream);
  if (!tails) return tails.error();
  path_.take(setpoint);
  path_.note(setpoint);
  drives_.follow(at_own_speed(std::move(way.value())), std::move(tails.value()), now);
  return std::nullopt;
}

// The stream ends by itself: the path behind its last setpoint comes to rest.
void Stream::poll(HostTime now) {
  if (stage_ == Stage::Loading) {
    if (all_are(drives_.axes(), AxisState::Loaded)) begin(now);
    return;
  }
  if (stage_ == Stage::Beginning && committed(drives_.axes())) join(now);
}

void Stream::begin(HostTime now) {
  const HostTime begin = now + host_duration(longest_lead(drives_.axes()).count());
  for (axis::Axis* axis : drives_.axes()) axis->arm(begin, now);
  signal_all(drives_.signals(), now);
  stage_ = Stage::Beginning;
}

// A setpoint that cannot be reached from here is passed over as one that has been lost: the next one may do.
void Stream::join(HostTime now) {
  stage_ = Stage::Following;
  if (!waiting_) return;
  const Setpoint setpoint = *std::exchange(waiting_, std::nullopt);
  if (!follow(setpoint, now)) return;
  path_.note(setpoint);
  --counters_.accepted;
  ++counters_.refused;
}

void Stream::take_waiting(HostTime now) {
  std::optional<Setpoint> setpoint = std::exchange(waiting_, std::nullopt);
  if (!setpoint || drives_.state() != GroupState::Idle) return;
  setpoint->time = now;  // as it has waited for the drives, not for its sender
  open(*setpoint, now);
}

}  // namespace interpolated_motion::motion
