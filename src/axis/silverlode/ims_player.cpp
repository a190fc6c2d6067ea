#include "interpolated_motion_driver/axis/silverlode/ims_player.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/queue_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/register_delivery.h"
#include "interpolated_motion_driver/protocol/silverlode/line_silence.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace registers = silverlode::registers;
using silverlode::Outcome;

namespace {

/// Longest for the start command to get over the line.
constexpr HostDuration kStartTimeout = 5s;
/// Of the lead, the part that the first segment of waiting takes; the second one takes the rest.
constexpr double kFirstWait = 0.5;
/// Longest the drive may take beyond the duration of its segments, for the error of its clock and the report.
constexpr HostDuration kOvertime = 500ms;

std::unique_ptr<SegmentDelivery> make_delivery(const SilverlodeAxisParameters& parameters,
                                               const DeliveryContext& context) {
  if (parameters.queue == SegmentQueue::Registers)
    return std::make_unique<RegisterDelivery>(context, parameters.segment_registers);
  return std::make_unique<QueueDelivery>(context, static_cast<std::size_t>(parameters.queue_depth));
}

/// Goal seconds per drive second for the next segment.
double rate_for_next(const SegmentFeed& feed, const PlaybackClock& clock, HostTime begin) {
  const HostTime knot = clock.host_time(feed.knot_end());
  const double due = (feed.start_goal_time() + GoalTime{seconds(knot - begin)}).count();
  return clock.goal_rate(due - feed.knot_goal_time().count());
}

/// A drive whose queue has run dry leaves the interpolated motion, and takes what comes afterwards all the
/// same. `number`: the segment that `outcome` has given to the drive.
std::optional<std::string> too_late(const SegmentFeed& feed, const PlaybackClock& clock, std::size_t number,
                                    const Outcome& outcome, const silverlode::LineMaster& line) {
  const double late = clock.least_elapsed(outcome.request_end) - feed.begin_of(number);
  if (late <= 0.0) return std::nullopt;
  return fmt::format(
      "its queue ran dry: a segment got over the line {:.3f} s after the one before had ended. {:.3f} s of "
      "motion are kept in the drive (commit_horizon): make it longer than the line is disturbed{}",
      late, feed.horizon(), silverlode::silence_text(line));
}

}  // namespace

ImsPlayer::ImsPlayer(SilverlodePowerStage& stage, LineStart* common_start)
    : stage_(stage),
      parameters_(stage.parameters()),
      clock_(parameters_.max_clock_error, 0.5 * seconds(parameters_.execution_time),
             PlaybackClock::Estimate::Middle),
      delivery_(make_delivery(parameters_, {stage.line(), stage.device(), stage.sequence(), feed_, clock_,
                                            parameters_.line_share})),
      loader_(stage, feed_, *delivery_),
      start_(stage, common_start),
      execution_(parameters_, feed_, clock_) {
  ims_goal_encoding(parameters_, *delivery_, stage_.line()).validate();
}

// For the power stage.

bool ImsPlayer::take(const Outcome& outcome, HostTime now) {
  if (!delivery_->owns(outcome)) return start_.take(outcome);
  const std::size_t before = delivery_->delivered();
  auto failure = delivery_->take(outcome, now);
  const bool given = phase_ == Phase::Moving && outcome.accepted() && delivery_->delivered() > before;
  if (!failure && given) {
    failure = too_late(feed_, clock_, before, outcome, stage_.line());
    underruns_ += failure ? 1U : 0U;
  }
  if (failure) stage_.fail(*failure, now);
  return true;
}

void ImsPlayer::begin(HostTime now) {
  enter(Phase::ReadingRest, now);
  stage_.sequence().start({stage_.commands().read(registers::kTargetPosition, rest_counts_)}, now);
}

void ImsPlayer::play(HostTime now) {
  switch (phase_) {
    case Phase::ReadingRest:
    case Phase::Emptying:
    case Phase::Braking:
      if (!stage_.sequence_done(now)) return;
      clock_.stop();
      return enter(Phase::Ready, now);
    case Phase::Loading:
      if (!loader_.poll(now)) return;
      minimum_fill_ = static_cast<std::uint32_t>(delivery_->capacity());
      return enter(Phase::Loaded, now);
    case Phase::Starting:
      return poll_starting(now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Ending:
      return poll_ending(now);
    case Phase::Ready:
    case Phase::Loaded:
      return stage_.watch_rest(now);
    case Phase::Off:
      return;
  }
}

AxisState ImsPlayer::enabled_state() const {
  switch (phase_) {
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Loading:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Starting:
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

void ImsPlayer::enter(Phase phase, HostTime now) {
  phase_ = phase;
  stage_.time().begin(now);
}

void ImsPlayer::give_up(HostTime) {
  phase_ = Phase::Off;
  delivery_->give_up();
  start_.withdraw();
  clock_.stop();
}

/// The drive goes through all that may be in its queue, and down the ramp of register 19.
HostDuration ImsPlayer::longest_motion(HostTime now) const {
  const double played = clock_.running() ? clock_.least_elapsed(now) : 0.0;
  const double queued = std::max(0.0, feed_.knot_end() - played) * (1.0 + parameters_.max_clock_error);
  const auto& limits = parameters_.limits;
  const double ramp = parameters_.limit_margin * limits.max_velocity / limits.max_acceleration;
  return host_duration(queued + ramp);
}

// From a path to a drive that plays it.

TailEncoderPtr ImsPlayer::encoder_at_rest(double rest, GoalTime) const {
  return ims_goal_encoder(parameters_, *delivery_, stage_.line(),
                          parameters_.transmission.nearest_counts(rest));
}

GoalTime ImsPlayer::start_lead() const {
  return GoalTime{ims_start_lead(parameters_, *delivery_, stage_.line())};
}

BusWatch ImsPlayer::bus_watch() const {
  constexpr double kSmallest = 1e-9;  // so that what goes with the start command counts
  const silverlode::LineMaster& line = stage_.line();
  const double filling = ims_filling_time(parameters_, *delivery_, line);
  // With a single block of registers every segment is as long as the line needs with a question.
  if (delivery_->shortest_segment() > 0.0 && delivery_->capacity() == 1)
    return {delivery_->record_time(), 0.0, 0.0, 0.0, GoalTime{filling + kSmallest}};
  return {delivery_->record_time(), seconds(look_time(line)), seconds(longest_look_time(line)),
          seconds(stage_.pace().overdue()), GoalTime{filling + kSmallest}};
}

void ImsPlayer::load(TailPtr tail, HostTime now) {
  const ImsPlan& plan = own<ImsPlan>(*tail);
  stream_origin_ = plan.origin;
  stream_begin_ = GoalTime{0.0};
  const double horizon = ims_horizon(parameters_, stream_origin_ ? Pace::Stream : Pace::Goal);
  feed_.load(plan.path, {plan.encoding, horizon}, rest_counts_, delivery_->capacity());
  lead_ = start_lead().count();
  feed_.wait(std::llround(kFirstWait * lead_ / parameters_.scale.tick));
  finished_ = false;
  begin_ = kNever;
  second_wait_made_ = false;
  delivery_->begin();
  execution_.begin();
  clock_.stop();
  underruns_at_load_ = underruns_;
  refused_at_load_ = delivery_->refused_writes();
  enter(Phase::Loading, now);
  loader_.begin(rest_counts_, now);
}

void ImsPlayer::arm(HostTime begin, HostTime now) {
  if (phase_ != Phase::Loaded) return;
  if (seconds(begin - now) < (1.0 - kLatestTold) * lead_) {
    return stage_.fail(
        fmt::format("it was told {:.3f} s before the common start that it needs to know {:.3f} s before: the "
                    "host has stalled",
                    seconds(begin - now), lead_),
        now);
  }
  begin_ = begin;
  if (stream_origin_) stream_begin_ = GoalTime{seconds(begin - *stream_origin_)};
  enter(Phase::Starting, now);
  start_.ask();
}

void ImsPlayer::poll_starting(HostTime now) {
  if (const auto failure = start_.poll(now)) return stage_.fail(*failure, now);
  if (!start_.sent()) {
    if (stage_.time().expired(now, kStartTimeout)) stage_.fail("IMS does not get over the line", now);
    return;
  }
  if (!clock_.running()) clock_.start(*start_.sent() + parameters_.execution_time / 2);
  if (start_.begun()) begin_motion(now);
}

/// A second segment of waiting takes what is left until the path begins, by what the drive's clock is known
/// to do.
void ImsPlayer::begin_motion(HostTime now) {
  enter(Phase::Moving, now);
  const double until_begin = seconds(begin_ - clock_.start_time()) * execution_.clock_rate();
  const auto ticks = std::llround((until_begin - feed_.queue_end()) / parameters_.scale.tick);
  if (ticks < 1) return stage_.fail("the start command came too late for the common start", now);
  feed_.wait(ticks);
  second_wait_made_ = true;
  poll_moving(now);
}

// A drive in motion.

void ImsPlayer::poll_moving(HostTime now) {
  if (const auto look = std::exchange(stage_.status().execution, std::nullopt)) {
    if (const auto failure = execution_.take(*look)) return stage_.fail(*failure, now);
  }
  const bool few = feed_.waiting(clock_.elapsed(now), true) < kLeastAhead;
  const bool within_horizon = feed_.queue_end() - clock_.elapsed(now) < feed_.horizon();
  const bool more = !feed_.all_sent() && (few || within_horizon);
  if (const auto failure = delivery_->offer(more, rate_for_next(feed_, clock_, begin_), now))
    return stage_.fail(*failure, now);
  if (!feed_.all_sent() && now >= begin_) {
    const auto fill = feed_.waiting(clock_.elapsed(now), true);
    minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(fill));
  }
  watch_motion(now);
}

void ImsPlayer::watch_motion(HostTime now) {
  SilverlodeStatus& status = stage_.status();
  const HostTime known = stage_.feedback().time;
  if (!status.silence.empty())
    return stage_.fail(fmt::format("the drive does not answer ({})", std::exchange(status.silence, {})), now);
  const bool looked = status.io_time > clock_.start_time();
  if (looked && status.io.fault()) return stage_.fail("the drive reports: " + status.io.text(), now);
  if (looked && !status.io.trajectory_active()) return end_of_motion(now);
  if (stage_.time().silence(now, std::max(known, clock_.start_time())) > stage_.pace().feedback_timeout()) {
    return stage_.fail(fmt::format("no position has come from the drive for {:.2f} s", seconds(now - known)),
                       now);
  }
  if (clock_.least_elapsed(status.io_time) > feed_.duration() + seconds(kOvertime)) {
    stage_.fail(
        fmt::format("the drive still moves {:.1f} s after the end of its segments", seconds(kOvertime)), now);
  }
}

void ImsPlayer::end_of_motion(HostTime now) {
  const HostTime looked = stage_.status().io_time;
  if (!feed_.all_sent() ||
      clock_.most_elapsed(looked) + seconds(parameters_.execution_time) < feed_.duration()) {
    ++underruns_;
    return stage_.fail(
        fmt::format("the drive left the interpolated motion {:.3f} s after the start "
                    "instead of {:.3f} s: its queue ran "
                    "dry, or something has stopped it{}",
                    clock_.elapsed(looked), feed_.duration(), silverlode::silence_text(stage_.line())),
        now);
  }
  enter(Phase::Ending, now);
  stage_.sequence().start(
      {stage_.commands().read(registers::kTargetPosition, rest_counts_), stage_.commands().read_position()},
      now);
}

// The drive's own target tells whether it has gone all of the way.
void ImsPlayer::poll_ending(HostTime now) {
  if (!stage_.sequence_done(now)) return;
  if (rest_counts_ != feed_.final_counts()) {
    return stage_.fail(
        fmt::format(
            "its target is {} counts after the motion instead of {}: a segment was lost or changed on "
            "the line",
            rest_counts_, feed_.final_counts()),
        now);
  }
  clock_.stop();
  finished_ = true;
  enter(Phase::Ready, now);
}

void ImsPlayer::stop(HostTime now) {
  delivery_->give_up();
  start_.withdraw();
  const bool moving = interpolates();
  if (!moving && phase_ != Phase::Loading && phase_ != Phase::Loaded) return;
  enter(moving ? Phase::Braking : Phase::Emptying, now);
  DriveCommands& commands = stage_.commands();
  stage_.sequence().start(moving ? commands.brake(delivery_->clear_steps(), rest_counts_)
                                 : commands.empty(delivery_->clear_steps(), rest_counts_),
                          now);
}

// A path that changes: it may do so behind the segment that has been encoded last.

Expected<TailPtr, Refusal> ImsPlayer::standing_tail(HostTime origin, GoalTime rest) const {
  auto plan = std::make_unique<ImsPlan>();
  plan->path = trajectory::with_rest(trajectory::Path(rest_position()), rest);
  plan->origin = origin;
  plan->encoding = ims_stream_encoding(parameters_, *delivery_, stage_.line());
  return TailPtr(std::move(plan));
}

std::optional<GoalTime> ImsPlayer::committed() const {
  if (phase_ == Phase::Ending || finished_) return kEndCommitted;
  if (phase_ != Phase::Moving) return std::nullopt;
  return feed_.ending() ? kEndCommitted : stream_begin_ + feed_.knot_goal_time();
}

void ImsPlayer::hold(GoalTime until) {
  feed_.commit(until - stream_begin_, rate_for_next(feed_, clock_, begin_));
}

TailEncoderPtr ImsPlayer::encoder_behind(Pace pace) const {
  return ims_way_on_encoder(parameters_, *delivery_, stage_.line(), feed_, stream_begin_, pace);
}

bool ImsPlayer::can_follow(const Tail& tail) const {
  return phase_ == Phase::Moving && !feed_.ending() &&
         feed_.knot_goal_time() == own<const ImsWayOn>(tail).from;
}

void ImsPlayer::follow(TailPtr tail) {
  ImsWayOn& way_on = own<ImsWayOn>(*tail);
  feed_.take_way_on(std::move(way_on.source), way_on.widest);
}

// Results.

double ImsPlayer::rest_position() const {
  const std::int32_t counts = stage_.enabled() ? rest_counts_ : stage_.status().actual_counts();
  return parameters_.transmission.joint_position(counts);
}

GoalTime ImsPlayer::playback_of_feed(HostTime when) const {
  if (!feed_.loaded()) return GoalTime{0.0};
  if (clock_.running() && second_wait_made_) return feed_.goal_time_at(clock_.elapsed(when));
  if (finished_) return feed_.path().end_time() + GoalTime{seconds(when - stage_.time().since())};
  return feed_.start_goal_time() - GoalTime{lead_};
}

void ImsPlayer::motion_status(HostTime now, AxisStatus& out) const {
  const double elapsed = clock_.elapsed(now);
  const bool playing = interpolates() && feed_.loaded();
  const AxisFeedback& feedback = stage_.feedback();
  const auto demand_at = [&](HostTime when) {
    return interpolates() ? feed_.path().sample(playback_of_feed(when)).position : rest_position();
  };
  out.demand_position = demand_at(now);
  out.following_error = demand_at(feedback.time) - feedback.position;
  out.capacity = static_cast<std::uint32_t>(delivery_->capacity());
  out.fill = feed_.loaded() && (playing || phase_ == Phase::Loaded)
                 ? static_cast<std::uint32_t>(feed_.waiting(elapsed, clock_.running()))
                 : 0;
  out.fill_time = playing ? std::max(0.0, feed_.queue_end() - elapsed) : 0.0;
  out.underflow_warning = playing && !feed_.all_sent() && out.fill == 0;
  out.overflow_warning = false;
  out.velocity_warning = out.acceleration_warning = false;
  out.underruns = underruns_;
  out.overflows = 0;
  out.refused_writes = delivery_->refused_writes();
  out.records_sent = delivery_->records_sent();
  out.clock_error_ppm = execution_.clock_error_ppm();
}

AxisReport ImsPlayer::report() const {
  return {feed_.sent(), minimum_fill_, underruns_ - underruns_at_load_,
          delivery_->refused_writes() - refused_at_load_};
}

}  // namespace interpolated_motion::axis
