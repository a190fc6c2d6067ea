#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;

namespace {

/// Periods from the moment a target position is chosen to the instant it is reached: it is sent right behind
/// the SYNC before its own.
constexpr int kLatency = 2;
/// For the host to come round to it.
constexpr GoalTime kHostMargin{0.005};
/// With more control frames than this waiting, the bus is down: what is sent now would arrive too late.
constexpr std::size_t kJammed = 128;

}  // namespace

encoding::SetpointEncoding CyclicAxis::encoding() const {
  encoding::SetpointEncoding encoding;
  encoding.joint = parameters_.joint;
  encoding.transmission = parameters_.transmission;
  encoding.period = GoalTime{seconds(parameters_.sync_period)};
  encoding.order = parameters_.interpolation_order;
  encoding.servo_period = GoalTime{parameters_.servo_period};
  encoding.bound_counts = parameters_.deviation_bound;
  return encoding;
}

std::optional<Refusal> CyclicAxis::plan(const trajectory::Path& path, GoalTime) {
  const auto certificate = encoding::certify_setpoints(path, encoding());
  if (!certificate) return certificate.error();
  planned_ = path;
  planned_origin_.reset();
  return std::nullopt;
}

GoalTime CyclicAxis::start_lead() const {
  return GoalTime{(kLatency + 1) * seconds(parameters_.sync_period)} + kHostMargin;
}

void CyclicAxis::load(HostTime now) {
  path_ = planned_;
  stream_origin_ = planned_origin_;
  begin_ = kNever;
  finished_ = false;
  sent_at_load_ = sent_;
  missed_at_load_ = setpoints_.missed();
  enter_phase(Phase::Loading, now);
}

// What has been sent for instants after the begin was rest, and cannot be taken back.
void CyclicAxis::arm(HostTime begin, HostTime now) {
  if (phase() != Phase::Loaded) return;
  if (begin < setpoints_.newest()) {
    return fail(fmt::format("it was told {:.3f} s before the common start that it needs to know {:.3f} s "
                            "before: the host has stalled",
                            seconds(begin - now), start_lead().count()),
                now);
  }
  begin_ = begin;
  if (stream_origin_) path_ = trajectory::shifted(path_, GoalTime{seconds(begin - *stream_origin_)});
  setpoints_.follow(path_, begin);
  enter_phase(Phase::Moving, now);
}

// ---- a path that is still being made

std::optional<Refusal> CyclicAxis::plan_stream(HostTime origin, GoalTime rest) {
  planned_ = trajectory::with_rest(trajectory::Path(rest_position()), rest);
  planned_origin_ = origin;
  return std::nullopt;
}

GoalTime CyclicAxis::stream_lead() const {
  return GoalTime{(kLatency + 1) * seconds(parameters_.sync_period)};
}

HostTime CyclicAxis::committed() const {
  return phase() == Phase::Moving && stream_origin_ ? setpoints_.newest() : kNever;
}

std::optional<Refusal> CyclicAxis::plan_follow(const trajectory::Path& path) {
  planned_ = path;
  return std::nullopt;
}

void CyclicAxis::follow() {
  path_ = planned_;
  begin_ = *stream_origin_ + host_duration(path_.start_time().count());
  setpoints_.follow(path_, begin_);
}

HostTime CyclicAxis::path_begin() const {
  return begin_ == kNever ? kNever : begin_ + host_duration(sync_delay());
}

GoalTime CyclicAxis::playback(HostTime when) const {
  if (begin_ == kNever) return path_.start_time() - start_lead();
  return goal_time_at(seconds(when - path_begin()));
}

bool CyclicAxis::wants_targets() const { return enabling() || enabled() || (disabling() && obeys()); }

/// One target position for each SYNC, right behind the SYNC before it.
void CyclicAxis::send_target() {
  if (!wants_targets() || master().pending_control() > kJammed) return;
  const auto target = setpoints_.next(master().next_sync_due());
  if (!target) return;
  std::uint8_t data[4];
  canopen::put_le(data, *target);
  const bool taken = node().send_rpdo(cyclic_pdo::kTargetRpdo, data, sizeof(data));
  ++(taken ? sent_ : refused_);
}

void CyclicAxis::poll_moving(HostTime now) {
  if (!telemetry_.statusword.follows_command()) {
    return fail(fmt::format("the drive no longer follows its target positions (bit 12); statusword: {}",
                            telemetry_.statusword.text()),
                now);
  }
  if (silence(now, feedback_.time) > parameters_.feedback_timeout) {
    return fail(
        fmt::format("no position has come from the drive for {:.2f} s", seconds(now - feedback_.time)), now);
  }
  if (!setpoints_.played(now)) return;
  finished_ = true;
  come_to_rest(now);
}

void CyclicAxis::stop(HostTime now) {
  switch (phase()) {
    case Phase::Loading:
    case Phase::Loaded:
      return enter_phase(Phase::Ready, now);
    case Phase::Moving:
      setpoints_.brake(parameters_.limits);
      return enter_phase(Phase::Braking, now);
    default:
      return;
  }
}

void CyclicAxis::poll_braking(HostTime now) {
  if (setpoints_.played(now)) come_to_rest(now);
}

void CyclicAxis::come_to_rest(HostTime now) {
  rest_counts_ = setpoints_.newest_counts();
  setpoints_.rest(rest_counts_);
  enter_phase(Phase::Ready, now);
}

}  // namespace interpolated_motion::axis
