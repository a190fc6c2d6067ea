#include "interpolated_motion_driver/axis/epos/pvt_player.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/epos/host_watch.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace cw = cia402::controlword;

namespace {

/// Longest from the start command to the drive's word that it plays (SYNC, its next sample, a TPDO), on a
/// host that is quick.
constexpr HostDuration kStartTimeout = 200ms;
/// Longest the drive may take beyond the duration of a plan, for the error of its clock and the report.
constexpr HostDuration kOvertime = 500ms;
constexpr double kHalfSample = 0.5e-3;

}  // namespace

PvtPlayer::PvtPlayer(Cia402PowerStage& stage, EposDevice& drive)
    : stage_(stage),
      drive_(drive),
      sender_(drive.node(), feed_, clock_),
      watch_(drive, stage.sequence(), feed_, sender_, clock_),
      loader_(stage, drive.parameters(), feed_, sender_, watch_) {}

// For the power stage.

void PvtPlayer::begin(HostTime now) {
  enter(Phase::ReadingRest, now);
  stage_.sequence().start({read_demand(rest_counts_)}, now);
}

void PvtPlayer::play(HostTime now) {
  switch (phase_) {
    case Phase::ReadingRest:
      if (stage_.sequence_done(now)) enter(Phase::Ready, now);
      return;
    case Phase::Loading:
      if (loader_.poll(now)) enter(Phase::Loaded, now);
      return;
    case Phase::Armed:
      return poll_armed(now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Ending:
      return poll_ending(now);
    case Phase::Braking:
      return poll_braking(now);
    case Phase::Emptying:
      return poll_emptying(now);
    case Phase::Off:
    case Phase::Ready:
    case Phase::Loaded:
      return;
  }
}

AxisState PvtPlayer::enabled_state() const {
  switch (phase_) {
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Loading:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Armed:
    case Phase::Moving:
    case Phase::Ending:
      return AxisState::Moving;
    case Phase::Braking:
    case Phase::Emptying:
      return AxisState::Stopping;
    case Phase::Off:
    case Phase::ReadingRest:
      break;
  }
  return AxisState::Enabling;
}

void PvtPlayer::enter(Phase phase, HostTime now) {
  phase_ = phase;
  stage_.time().begin(now);
}

void PvtPlayer::give_up(HostTime) {
  phase_ = Phase::Off;
  sender_.withdraw();
}

/// The drive goes on through its FIFO, or until it misses the host's heartbeat if it hears nothing any more,
/// and then down its quick-stop ramp. As long as its heartbeat comes, it may hear the host and go on. The
/// last that has come of it shows that it could still be heard, and so hear, until the SYNC after that.
HostDuration PvtPlayer::longest_motion(HostTime now) const {
  const EposAxisParameters& p = drive_.parameters();
  const double played = clock_.least_elapsed(now);
  const double queued = feed_.time_ahead(played) * (1.0 + PlaybackClock::kMaxError);
  const canopen::HeartbeatConsumer& heartbeat = drive_.node().heartbeat();
  const HostTime heard = std::max(drive_.feedback().time, heartbeat.last_heard());
  const HostTime misses_host = heard + drive_.master().parameters().sync_period + p.host_watch;
  const bool watches_host = p.abort_connection_option != 0 && heartbeat.lost();
  const double alone = watches_host ? std::max(0.0, seconds(misses_host - now)) : queued;
  const double fastest = feed_.fastest_ahead(played, drive_.counts_per_second(1));
  const double deceleration = p.limits.max_acceleration * std::abs(p.transmission.counts_per_radian());
  return host_duration(std::min(queued, alone) + fastest / deceleration);
}

// Plan and load.

TailEncoderPtr PvtPlayer::encoder_at_rest(double rest, GoalTime wait) const {
  return pvt_goal_encoder(drive_, wait, drive_.parameters().transmission.nearest_counts(rest));
}

void PvtPlayer::load(TailPtr tail, HostTime now) {
  PvtPlan& plan = own<PvtPlan>(*tail);
  feed_ = std::move(plan.feed);
  wait_ = plan.wait;
  stream_origin_ = plan.origin;
  timeline_.begin(plan.start - plan.wait);
  finished_ = false;
  clock_.stop();
  underruns_at_load_ = drive_.underruns();
  lost_at_load_ = watch_.lost();
  watch_.filled(0);
  enter(Phase::Loading, now);
  loader_.begin(now);
}

// Playing.

void PvtPlayer::arm(HostTime, HostTime now) {
  if (phase_ != Phase::Loaded) return;
  enter(Phase::Armed, now);
  watch_.begin();
  stage_.controlword().send(cw::kStartInterpolation, now);
}

HostTime PvtPlayer::path_begin() const { return clock_.running() ? clock_.host_time(wait_.count()) : kNever; }

/// The drive starts at its first sample after SYNC.
void PvtPlayer::start_clock() {
  if (clock_.running() || !stage_.controlword().applied()) return;
  clock_.start(drive_.master().last_sync_time() + host_duration(kHalfSample),
               drive_.facts().takes_time_stamps);
  if (stream_origin_) timeline_.begin(GoalTime{seconds(clock_.start_time() - *stream_origin_)});
  origin_ = clock_.start_time() - host_duration(timeline_.at(0.0).count());
}

void PvtPlayer::poll_armed(HostTime now) {
  const bool late = stage_.time().expired(now, drive_.patience(kStartTimeout));
  const EposTelemetry& report = drive_.report();
  start_clock();
  if (!clock_.running()) {
    if (late) stage_.fail("its start command does not get onto the bus", now);
    return;
  }
  sender_.send(now);
  if (report.statusword.ip_mode_active()) return enter(Phase::Moving, now);
  if (feed_.all_sent() && clock_.least_elapsed(report.status_time) > feed_.duration())
    return end_of_motion(now);
  if (late) {
    stage_.fail(fmt::format("the drive does not start to interpolate; statusword: {}, FIFO: {}",
                            report.statusword.text(), report.buffer_status.text()),
                now);
  }
}

// A drive that has lost a record is stopped before it gets there.
void PvtPlayer::poll_moving(HostTime now) {
  if (const auto failure = watch_.check(now)) return stage_.fail(*failure, now);
  sender_.send(now);
  watch_motion(now);
}

void PvtPlayer::watch_motion(HostTime now) {
  const EposTelemetry& report = drive_.report();
  if (!report.statusword.ip_mode_active()) return end_of_motion(now);
  const HostTime known = drive_.feedback().time;
  if (stage_.time().silence(now, known) > drive_.parameters().feedback_timeout) {
    return stage_.fail(fmt::format("no position has come from the drive for {:.2f} s", seconds(now - known)),
                       now);
  }
  const double overtime = seconds(drive_.patience(kOvertime));
  if (clock_.least_elapsed(report.status_time) > feed_.duration() + overtime) {
    stage_.fail(fmt::format("the drive still interpolates {:.1f} s after the end of its records", overtime),
                now);
  }
}

void PvtPlayer::end_of_motion(HostTime now) {
  const EposTelemetry& report = drive_.report();
  const auto too_early = [&] { return clock_.most_elapsed(report.status_time) < feed_.duration(); };
  if (clock_.follows_host() && too_early()) clock_.stop_following();
  if (!feed_.all_sent() || too_early()) {
    return stage_.fail(
        fmt::format("the drive left the interpolation {:.3f} s after the start instead of {:.3f} s; FIFO: {}",
                    clock_.elapsed(report.status_time), feed_.duration(), report.buffer_status.text()),
        now);
  }
  rest_counts_ = feed_.final_position();
  enter(Phase::Ending, now);
  watches_as_at_rest_ = false;
  stage_.controlword().send(cw::kEnableOperation, now);
}

// The next start needs a rising edge of bit 4, so the drive must have seen it fall.
void PvtPlayer::poll_ending(HostTime now) {
  ControlwordLink& controlword = stage_.controlword();
  if (!controlword.applied()) {
    if (controlword.overdue(now)) controlword.send(cw::kEnableOperation, now);
    return;
  }
  if (!watches_as_at_rest_) {
    if (stage_.sequence().running()) return;
    watches_as_at_rest_ = true;
    stage_.sequence().start({watch_host_at_rest(drive_.parameters())}, now);
  }
  if (!stage_.sequence_done(now)) return;
  finished_ = true;
  enter(Phase::Ready, now);
}

// A path that changes: what the drive is not committed to is encoded anew.

Expected<TailPtr, Refusal> PvtPlayer::standing_tail(HostTime origin, GoalTime rest) const {
  return plan_pvt_standing(drive_, origin, rest, rest_counts_);
}

double PvtPlayer::kept_until() const { return 1e-3 * static_cast<double>(feed_.committed_knot().sample); }

std::optional<GoalTime> PvtPlayer::committed() const {
  if (phase_ == Phase::Ending || finished_) return kEndCommitted;
  if (phase_ != Phase::Moving) return std::nullopt;
  return feed_.all_committed() ? kEndCommitted : timeline_.at(kept_until());
}

void PvtPlayer::hold(GoalTime until) {
  const double known = kept_until();
  feed_.commit(known + (until - timeline_.at(known)).count());
}

TailEncoderPtr PvtPlayer::encoder_behind(Pace pace) const {
  const double from = kept_until();
  const GoalTime reached = timeline_.at(from);
  const double due = seconds(clock_.host_time(from) - origin_);
  const double rate = clock_.goal_rate(due - reached.count());
  return pvt_way_on_encoder(drive_, pace, {feed_.committed_knot(), reached, rate, feed_.committed_part()});
}

bool PvtPlayer::can_follow(const Tail& tail) const {
  const encoding::PvtKnot& from = own<const PvtWayOn>(tail).from;
  return phase_ == Phase::Moving && !feed_.all_committed() && feed_.committed_knot().sample == from.sample;
}

void PvtPlayer::follow(TailPtr tail) {
  PvtWayOn& way_on = own<PvtWayOn>(*tail);
  timeline_.change_rate(kept_until(), way_on.rate);
  feed_.replace_uncommitted(way_on.stream, way_on.limits);
}

// Stopping.

void PvtPlayer::stop(HostTime now) {
  sender_.withdraw();
  switch (phase_) {
    case Phase::Armed:
    case Phase::Moving:
      enter(Phase::Braking, now);
      return stage_.controlword().send(cw::kStartInterpolation | cw::kHaltBit, now);
    case Phase::Loading:
    case Phase::Loaded:
      return start_emptying(now);
    default:
      return;
  }
}

void PvtPlayer::poll_braking(HostTime now) {
  ControlwordLink& controlword = stage_.controlword();
  if (stage_.halted()) {
    controlword.send(cw::kHalt, now);
    return start_emptying(now);
  }
  if (!controlword.applied() && controlword.overdue(now)) controlword.send(controlword.word(), now);
  const auto& limits = drive_.parameters().limits;
  const double longest = limits.max_velocity / limits.max_acceleration;
  if (stage_.time().expired(now, host_duration(2.0 * longest) + drive_.patience(kOvertime)))
    stage_.fail("the drive was told to halt but does not come to rest", now);
}

void PvtPlayer::start_emptying(HostTime now) {
  enter(Phase::Emptying, now);
  stage_.sequence().start({close_fifo(), watch_host_at_rest(drive_.parameters()), read_demand(rest_counts_)},
                          now);
}

// Halt is taken back last, when neither bit 4 nor a record could make the drive go on.
void PvtPlayer::poll_emptying(HostTime now) {
  ControlwordLink& controlword = stage_.controlword();
  if (!stage_.sequence_done(now) || !controlword.applied()) return;
  if (controlword.word() != cw::kEnableOperation) return controlword.send(cw::kEnableOperation, now);
  enter(Phase::Ready, now);
}

// Results.

double PvtPlayer::rest_position() const {
  const std::int32_t counts = stage_.enabled() ? rest_counts_ : drive_.report().position;
  return drive_.parameters().transmission.joint_position(counts);
}

void PvtPlayer::motion_status(HostTime now, AxisStatus& out) const {
  const auto& transmission = drive_.parameters().transmission;
  const EposTelemetry& report = drive_.report();
  const double elapsed = clock_.elapsed(now);
  const bool holds_records = phase_ == Phase::Loading || phase_ == Phase::Loaded || is_playing();
  out.demand_position = transmission.joint_position(report.position_demand);
  out.following_error = report.following_error / transmission.counts_per_radian();
  out.capacity = drive_.facts().capacity;
  out.fill = holds_records
                 ? static_cast<std::uint32_t>(feed_.sent() - std::min(feed_.sent(), feed_.played(elapsed)))
                 : 0;
  out.fill_time = holds_records ? feed_.time_ahead(elapsed) : 0.0;
  out.underflow_warning = report.buffer_status.underflow_warning();
  out.overflow_warning = report.buffer_status.overflow_warning();
  out.velocity_warning = report.buffer_status.velocity_warning();
  out.acceleration_warning = report.buffer_status.acceleration_warning();
  out.underruns = drive_.underruns();
  out.overflows = drive_.overflows();
  out.refused_writes = watch_.lost();
  out.records_sent = sender_.sent();
  out.clock_error_ppm = clock_.error_ppm();
}

AxisReport PvtPlayer::report() const {
  return {feed_.sent(), watch_.minimum_fill(), drive_.underruns() - underruns_at_load_,
          watch_.lost() - lost_at_load_};
}

}  // namespace interpolated_motion::axis
