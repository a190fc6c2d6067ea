#include "interpolated_motion_driver/axis/cyclic/setpoint_player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

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
/// So long before SYNC a drive that is not heard of gets its target position again.
constexpr HostDuration kRepeat = 1ms;
/// Longest that drives are known to ride out missing target positions, periods.
constexpr int kRideThrough = 10;

template <class Value>
Value in_range(double value) {
  constexpr double kLow = std::numeric_limits<Value>::min();
  constexpr double kHigh = std::numeric_limits<Value>::max();
  return static_cast<Value>(std::clamp(std::round(value), kLow, kHigh));
}

/// 0x60B1, in the unit of 0x606C.
std::int32_t velocity_offset(const CyclicAxisParameters& p, double velocity) {
  return in_range<std::int32_t>(p.transmission.counts_per_second(velocity) / p.velocity_unit);
}

/// 0x60B2, per mille of the rated torque, positive where counts go up.
std::int16_t torque_offset(const CyclicAxisParameters& p, double acceleration) {
  const double torque = p.torque_per_acceleration * acceleration;
  return in_range<std::int16_t>(std::copysign(1.0, p.transmission.counts_per_radian()) * torque);
}

}  // namespace

// For the power stage.

void SetpointPlayer::begin(HostTime now) {
  rest_counts_ = drive_.enabled_at();
  enter(Phase::Following, now);
  poll_following(now);
}

void SetpointPlayer::play(HostTime now) {
  switch (phase_) {
    case Phase::Following:
      return poll_following(now);
    case Phase::Loading:
      return enter(Phase::Loaded, now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Braking:
      if (drive_.setpoints().played(now)) come_to_rest(now);
      return;
    case Phase::Off:
    case Phase::Ready:
    case Phase::Loaded:
      return;
  }
}

AxisState SetpointPlayer::enabled_state() const {
  switch (phase_) {
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Loading:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Moving:
      return AxisState::Moving;
    case Phase::Braking:
      return AxisState::Stopping;
    case Phase::Off:
    case Phase::Following:
      break;
  }
  return AxisState::Enabling;
}

void SetpointPlayer::enter(Phase phase, HostTime now) {
  phase_ = phase;
  stage_.time().begin(now);
}

void SetpointPlayer::poll_following(HostTime now) {
  const cia402::Statusword statusword = drive_.report().statusword;
  if (statusword.follows_command()) return enter(Phase::Ready, now);
  if (stage_.time().expired(now, Cia402PowerStage::kStateTimeout)) {
    stage_.fail(
        fmt::format("the drive is enabled but does not follow its target position (bit 12); statusword: {}",
                    statusword.text()),
        now);
  }
}

/// A drive that is still enabled is told to brake by its quick stop, at rest as well: it gets no target
/// positions any more.
void SetpointPlayer::give_up(HostTime now) {
  phase_ = Phase::Off;
  const bool obeys = drive_.report().statusword.state() == cia402::State::OperationEnabled;
  if (obeys) stage_.controlword().send(drive_.stop_word(), now);
}

/// Without target positions the drive goes on along its polynomial for a few periods, then brakes.
HostDuration SetpointPlayer::longest_motion(HostTime) const {
  const auto& limits = drive_.parameters().limits;
  return kRideThrough * drive_.parameters().sync_period +
         host_duration(limits.max_velocity / limits.max_acceleration);
}

/// A drive that hears again takes with the first SYNC what it has: if nothing else, a target position of
/// before it fell silent. So it gets the newest one twice, the second time shortly before SYNC.
HostTime SetpointPlayer::repeat_due() const {
  const bool waits = !repeated_ && stage_.wants_targets() && sent_for_ == drive_.master().next_sync_due();
  return waits ? sent_for_ - std::min(kRepeat, drive_.parameters().sync_period / 4) : kNever;
}

/// One target position for each SYNC, right behind the SYNC before it.
void SetpointPlayer::send_target(HostTime now) {
  canopen::Master& master = drive_.master();
  SetpointStream& setpoints = drive_.setpoints();
  setpoints.leave_out(master.sync_timing().first_left_out(), master.sync_timing().last_left_out());
  const bool sends = stage_.wants_targets() && master.pending_control() <= kJammed;
  const bool heard = drive_.report().position_time >= master.last_sync_time();
  const auto target = sends ? setpoints.next(master.next_sync_due(), heard) : std::nullopt;
  if (target) {
    sent_for_ = master.next_sync_due();
    repeated_ = heard;
    ++(send(*target) ? sent_ : refused_);
  }
  if (sends && now >= repeat_due()) {
    repeated_ = true;
    send(setpoints.newest_counts());
  }
  if (const auto detour = setpoints.take_detour()) tell(*detour, now);
  drive_.node().set_needs_sync(stage_.wants_targets() && !setpoints.is_led());
}

void SetpointPlayer::tell(const Detour& detour, HostTime now) {
  stage_.notes().add({true, fmt::format("Joint '{}': target positions have not reached its drive in time. It "
                                        "has gone on by itself and is led back to its path within {:.3f} s, "
                                        "{:.0f} counts off at most.",
                                        drive_.parameters().joint, seconds(detour.duration), detour.counts)},
                     now);
}

/// The torque first: the drive takes all of them at SYNC.
bool SetpointPlayer::send(std::int32_t target) {
  const trajectory::State motion = drive_.setpoints().newest_motion();
  canopen::NodeLink& node = drive_.node();
  if (drive_.facts().takes_torque) {
    std::uint8_t torque[2];
    canopen::put_le(torque, torque_offset(drive_.parameters(), motion.acceleration));
    node.send_rpdo(cyclic_pdo::kTorqueRpdo, torque, sizeof(torque));
  }
  std::uint8_t data[8];
  canopen::put_le(data, target);
  canopen::put_le(data + 4, velocity_offset(drive_.parameters(), motion.velocity));
  return node.send_rpdo(cyclic_pdo::kTargetRpdo, data, drive_.facts().takes_velocity ? 8 : 4);
}

// A goal's way.

TailEncoderPtr SetpointPlayer::encoder_at_rest(double, GoalTime) const {
  return setpoint_goal_encoder(setpoint_encoding(drive_.parameters()));
}

GoalTime SetpointPlayer::start_lead() const {
  return GoalTime{(kLatency + 1) * seconds(drive_.parameters().sync_period)} + kHostMargin;
}

void SetpointPlayer::load(TailPtr tail, HostTime now) {
  SetpointTail& plan = own<SetpointTail>(*tail);
  path_ = std::move(plan.path);
  stream_origin_ = plan.origin;
  held_ = HostTime::min();
  begin_ = kNever;
  finished_ = false;
  sent_at_load_ = sent_;
  missed_at_load_ = drive_.setpoints().missed();
  report_.reset();
  enter(Phase::Loading, now);
}

// What has been sent for instants after the begin was rest, and cannot be taken back.
void SetpointPlayer::arm(HostTime begin, HostTime now) {
  if (phase_ != Phase::Loaded) return;
  if (begin < drive_.setpoints().newest()) {
    return stage_.fail(
        fmt::format("it was told {:.3f} s before the common start that it needs to know {:.3f} s "
                    "before: the host has stalled",
                    seconds(begin - now), start_lead().count()),
        now);
  }
  begin_ = begin;
  if (stream_origin_) path_ = trajectory::shifted(path_, GoalTime{seconds(begin - *stream_origin_)});
  origin_ = stream_origin_ ? *stream_origin_ : begin - host_duration(path_.start_time().count());
  drive_.setpoints().follow(path_, begin);
  enter(Phase::Moving, now);
}

void SetpointPlayer::poll_moving(HostTime now) {
  const cia402::Statusword statusword = drive_.report().statusword;
  const HostTime known = drive_.feedback().time;
  if (!statusword.follows_command()) {
    return stage_.fail(
        fmt::format("the drive no longer follows its target positions (bit 12); statusword: {}",
                    statusword.text()),
        now);
  }
  if (stage_.time().silence(now, known) > drive_.parameters().feedback_timeout) {
    return stage_.fail(fmt::format("no position has come from the drive for {:.2f} s", seconds(now - known)),
                       now);
  }
  if (drive_.setpoints().astray()) {
    return stage_.fail(
        fmt::format("the host was away so long that the drive has gone astray without target positions ({} "
                    "missed in this motion), and the joint's limits allow no way back to its path",
                    drive_.setpoints().missed() - missed_at_load_),
        now);
  }
  if (!drive_.setpoints().played(now)) return;
  finished_ = true;
  come_to_rest(now);
}

void SetpointPlayer::stop(HostTime now) {
  switch (phase_) {
    case Phase::Loading:
    case Phase::Loaded:
      return enter(Phase::Ready, now);
    case Phase::Moving:
      drive_.setpoints().brake();
      return enter(Phase::Braking, now);
    default:
      return;
  }
}

void SetpointPlayer::come_to_rest(HostTime now) {
  report_ = report();
  rest_counts_ = drive_.setpoints().newest_counts();
  drive_.setpoints().rest(rest_counts_);
  enter(Phase::Ready, now);
}

// A path that changes.

Expected<TailPtr, Refusal> SetpointPlayer::standing_tail(HostTime origin, GoalTime rest) const {
  auto tail = std::make_unique<SetpointTail>();
  tail->path = trajectory::with_rest(trajectory::Path(rest_position()), rest);
  tail->origin = origin;
  return TailPtr(std::move(tail));
}

GoalTime SetpointPlayer::stream_lead() const {
  return GoalTime{(kLatency + 1) * seconds(drive_.parameters().sync_period)};
}

/// At the instant of a target position, that of the newest one or a later one.
std::optional<GoalTime> SetpointPlayer::committed() const {
  if (finished_) return kEndCommitted;
  if (phase_ != Phase::Moving) return std::nullopt;
  const HostDuration period = drive_.parameters().sync_period;
  HostTime until = drive_.setpoints().newest();
  if (held_ > until) until += (held_ - until + period - HostDuration{1}) / period * period;
  return GoalTime{seconds(until - origin_)};
}

void SetpointPlayer::hold(GoalTime until) { held_ = origin_ + host_duration(until.count()); }

trajectory::DemandCheck SetpointPlayer::demand_check() const {
  return [this, encoding = setpoint_encoding(drive_.parameters())](
             const trajectory::Path& way_on) -> std::optional<trajectory::LimitViolation> {
    const auto peak = encoding::find_acceleration_beyond(path_, *committed(), way_on, encoding);
    if (!peak) return std::nullopt;
    trajectory::LimitViolation violation;
    violation.quantity = trajectory::Quantity::Acceleration;
    violation.time = peak->time;
    violation.value = peak->acceleration;
    violation.minimum = -encoding.max_acceleration;
    violation.maximum = encoding.max_acceleration;
    return violation;
  };
}

TailEncoderPtr SetpointPlayer::encoder_behind(Pace pace) const {
  encoding::SetpointEncoding encoding = setpoint_encoding(drive_.parameters());
  if (pace == Pace::Goal) return setpoint_way_on_encoder(encoding, *committed());
  encoding.bound_counts = drive_.parameters().stream_deviation_bound;
  return setpoint_stream_encoder(encoding, *committed());
}

bool SetpointPlayer::can_follow(const Tail& tail) const {
  const auto until = committed();
  const GoalTime late{0.5 * seconds(drive_.parameters().sync_period)};
  return until && *until < own<const SetpointTail>(tail).from + late;
}

void SetpointPlayer::follow(TailPtr tail) {
  path_ = std::move(own<SetpointTail>(*tail).path);
  begin_ = origin_ + host_duration(path_.start_time().count());
  drive_.setpoints().follow(path_, begin_);
}

// Results.

HostTime SetpointPlayer::path_begin() const {
  return begin_ == kNever ? kNever : begin_ + host_duration(drive_.master().sync_timing().delay());
}

GoalTime SetpointPlayer::playback(HostTime when) const {
  if (begin_ == kNever) return path_.start_time() - start_lead();
  return goal_time_at(seconds(when - path_begin()));
}

double SetpointPlayer::rest_position() const {
  const std::int32_t counts = stage_.enabled() ? rest_counts_ : drive_.report().position;
  return drive_.parameters().transmission.joint_position(counts);
}

void SetpointPlayer::motion_status(HostTime now, AxisStatus& out) const {
  const auto& transmission = drive_.parameters().transmission;
  const SetpointStream& setpoints = drive_.setpoints();
  const HostDuration ahead = setpoints.newest() - now;
  const bool streams = stage_.wants_targets() && ahead > 0ns;
  out.demand_position = transmission.joint_position(drive_.report().position_demand);
  out.following_error = drive_.report().following_error / transmission.counts_per_radian();
  out.capacity = 1;
  out.fill = streams ? 1 : 0;
  out.fill_time = streams ? seconds(ahead) : 0.0;
  out.underflow_warning = out.overflow_warning = false;
  out.velocity_warning = out.acceleration_warning = false;
  out.underruns = static_cast<std::uint32_t>(setpoints.missed());
  out.overflows = 0;
  out.refused_writes = static_cast<std::uint32_t>(refused_);
  out.records_sent = sent_;
  out.clock_error_ppm = 0.0;
}

AxisReport SetpointPlayer::report() const {
  if (report_) return *report_;
  const auto missed = static_cast<std::uint32_t>(drive_.setpoints().missed() - missed_at_load_);
  return {sent_ - sent_at_load_, missed == 0 ? 1U : 0U, missed};
}

}  // namespace interpolated_motion::axis
