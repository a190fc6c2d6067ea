#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode_axis.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace registers = silverlode::registers;
using silverlode::NakCode;
using silverlode::Outcome;

namespace {

/// Longest for one segment to get over the line before the motion.
constexpr HostDuration kFillTimeout = 5s;
/// Longest the drive may take beyond the duration of its segments, for the error of its clock and the report.
constexpr HostDuration kOvertime = 500ms;
/// After a queue was full that should not have been, the clock of the drive may be a little off.
constexpr HostDuration kRetryInterval = 5ms;
/// An error of play-back time is made good within about this time, s.
constexpr double kCatchUpTime = 2.0;
/// Of the lead, the part that the first segment of waiting takes; the second one takes the rest.
constexpr double kFirstWait = 0.5;
/// Share of the lead that may be gone when the axis is told the begin.
constexpr double kLatestTold = 0.3;
/// A look at the drive's clock that differs more than this (s) from what is expected is none.
constexpr double kPlausible = 0.02;
/// Times in a row that a drive may refuse a segment as unreadable.
constexpr int kMisunderstood = 3;
/// Looks in a row that must contradict what was sent: one may fall between two segments.
constexpr int kMisfits = 2;
/// Segments that are kept in the queue however short the horizon.
constexpr std::size_t kLeastAhead = 2;

}  // namespace

// ---- plan and load
// -----------------------------------------------------------------------------------------------------------------

encoding::ImsEncoding SilverlodeAxis::encoding() const {
  encoding::ImsEncoding encoding;
  encoding.joint = parameters_.joint;
  encoding.transmission = parameters_.transmission;
  encoding.scale = parameters_.scale;
  encoding.bound_counts = parameters_.deviation_bound;
  encoding.max_motor_rpm = parameters_.scale.velocity_full_scale_rpm;
  encoding.max_motor_acceleration =
      parameters_.limit_margin *
      std::abs(parameters_.transmission.motor_rpm(parameters_.limits.max_acceleration));
  return encoding;
}

std::optional<Refusal> SilverlodeAxis::plan(const trajectory::Path& path, GoalTime) {
  const auto stream = encoding::encode_ims(path, encoding(), rest_counts_);
  if (!stream) return stream.error();
  planned_path_ = path;
  planned_slots_ = slots_of(stream.value(), path.start_time());
  return std::nullopt;
}

// A segment must be there when the one before it has been executed. Its place becomes free when the drive
// begins the segment `depth_` before it; the first ones are there when the path begins.
std::vector<RecordSlot> SilverlodeAxis::slots_of(const encoding::ImsStream& stream, GoalTime start) const {
  std::vector<double> begins{0.0};
  for (const ImsSegment& segment : stream.segments) begins.push_back(begins.back() + segment.time * tick());
  std::vector<RecordSlot> slots(begins.size());
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const double place_free = i < depth_ ? 0.0 : begins[i - depth_];
    const double in_horizon = i < kLeastAhead ? 0.0 : begins[i] - parameters_.commit_horizon;
    const double soon_enough = i < kLeastAhead ? 0.0 : begins[i - kLeastAhead];
    slots[i].release = start + GoalTime{std::max(place_free, std::min(in_horizon, soon_enough))};
    slots[i].deadline = start + GoalTime{begins[i]};
  }
  return slots;
}

void SilverlodeAxis::load(HostTime now) {
  feed_.load(planned_path_, encoding(), rest_counts_, depth_);
  feed_.wait(std::llround(kFirstWait * parameters_.start_lead / tick()));
  finished_ = false;
  begin_ = kNever;
  second_wait_made_ = false;
  delivery_ = Delivery::None;
  misfits_ = 0;
  misunderstood_ = 0;
  clock_.stop();
  underruns_at_load_ = underruns_;
  refused_at_load_ = refused_writes_;
  enter(Phase::Clearing, now);
  auto steps = clear_status();
  steps.push_back({silverlode::imq_request(device_.address()), {}});
  steps.push_back(
      {silverlode::rrg_request(device_.address(), registers::kImsDeceleration), store(read_deceleration_)});
  steps.push_back(
      {silverlode::rrg_request(device_.address(), registers::kTargetPosition), store(read_target_)});
  sequence_.start(std::move(steps), now);
}

void SilverlodeAxis::poll_clearing(HostTime now) {
  if (!sequence_done(now)) return;
  if (read_deceleration_ != underrun_deceleration()) {
    return go_offline(
        "the drive has restarted: register 19 is not as it was set, and its position may be lost too", now);
  }
  if (read_target_ != rest_counts_) {
    return fail(
        fmt::format("its target was {} counts when the goal was planned and is {} counts now: something else "
                    "moves this drive",
                    rest_counts_, read_target_),
        now);
  }
  enter(Phase::Filling, now);
}

void SilverlodeAxis::poll_filling(HostTime now) {
  if (feed_.sent() == 1) {
    minimum_fill_ = static_cast<std::uint32_t>(depth_);
    return enter(Phase::Loaded, now);
  }
  offer(now);
  if (phase_ == Phase::Filling && expired(now, kFillTimeout))
    fail("its first segment does not get over the line: is the line overloaded or down?", now);
}

// ---- start
// -------------------------------------------------------------------------------------------------------------------------

void SilverlodeAxis::arm(HostTime begin, HostTime now) {
  if (phase_ != Phase::Loaded) return;
  if (seconds(begin - now) < (1.0 - kLatestTold) * parameters_.start_lead) {
    return fail(
        fmt::format("it was told {:.3f} s before the common start that it needs to know {:.3f} s before: the "
                    "host has stalled",
                    seconds(begin - now), parameters_.start_lead),
        now);
  }
  begin_ = begin;
  enter(Phase::Starting, now);
  start_id_ = device_.request(silverlode::ims_request(device_.address(), parameters_.ims_arguments));
}

// Without an answer to IMS it is not known whether the drive has begun; it only waits so far, so it is
// stopped.
void SilverlodeAxis::take_start(const Outcome& outcome, HostTime now) {
  if (phase_ != Phase::Starting) return;
  if (!outcome.accepted()) return fail_in_motion(device_.text(outcome), now);
  clock_.start(outcome.request_end);
  enter(Phase::Moving, now);
  make_second_wait(now);
}

void SilverlodeAxis::poll_starting(HostTime now) {
  if (expired(now, kFillTimeout)) fail_in_motion("IMS does not get over the line", now);
}

/// The waiting that is left until the path begins, by what the drive's clock is known to do.
void SilverlodeAxis::make_second_wait(HostTime now) {
  const double until_begin = seconds(begin_ - clock_.start_time()) * drive_rate();
  const auto ticks = std::llround((until_begin - feed_.queue_end()) / tick());
  if (ticks < 1) return fail_in_motion("the start command came too late for the common start", now);
  feed_.wait(ticks);
  second_wait_made_ = true;
}

// ---- feeding
// -----------------------------------------------------------------------------------------------------------------------

void SilverlodeAxis::feed(HostTime now) {
  if (!second_wait_made_ || feed_.all_sent()) return;
  const bool few = feed_.waiting(clock_.elapsed(now), true) < kLeastAhead;
  const bool within_horizon = feed_.queue_end() - clock_.elapsed(now) < parameters_.commit_horizon;
  if (few || within_horizon) offer(now);
}

/// Offers the next segment to the line, when the drive has a place for it.
void SilverlodeAxis::offer(HostTime now) {
  if (segment_id_ != silverlode::kNoRequest || now < retry_at_) return;
  const bool repeat = delivery_ == Delivery::Unknown;
  if (!repeat && !feed_.has_place(clock_.least_elapsed(now), clock_.running())) return;
  const auto segment = feed_.next(rate_for_next());
  if (!segment) return fail_in_motion(segment.error().text, now);
  const ImsSegment& s = segment.value();
  const HostTime deadline = clock_.running() ? clock_.host_time(feed_.queue_end()) : now;
  segment_id_ = device_.offer_bulk(
      silverlode::imw_request(device_.address(), s.time, s.position, s.acceleration, s.velocity), deadline);
  if (segment_id_ != silverlode::kNoRequest) delivery_ = repeat ? Delivery::SentAgain : Delivery::Sent;
}

/// Goal seconds per drive second for the next segment: the drive's own rate made good, and what it is ahead
/// or behind.
double SilverlodeAxis::rate_for_next() const {
  if (!clock_.running()) return 1.0;
  const double drive_rate = 1.0 + 1e-6 * clock_.error_ppm();
  const HostTime knot = clock_.host_time(feed_.queue_end());
  const double due = (feed_.path().start_time() + GoalTime{seconds(knot - begin_)}).count();
  const double behind = due - feed_.knot_goal_time().count();
  const double rate = 1.0 / drive_rate + behind / kCatchUpTime;
  return std::clamp(rate, 1.0 - 2.0 * parameters_.max_clock_error, 1.0 + 2.0 * parameters_.max_clock_error);
}

void SilverlodeAxis::take_delivery(const Outcome& outcome, HostTime now) {
  const Delivery delivery = std::exchange(delivery_, Delivery::None);
  if (outcome.kind == silverlode::OutcomeKind::Dropped || delivery == Delivery::None) return;
  const bool was_in = delivery == Delivery::SentAgain && outcome.refused_with(NakCode::BufferFull);
  if (outcome.accepted() || was_in) {
    feed_.mark_sent();
    ++records_sent_;
    misunderstood_ = 0;
    return;
  }
  if (outcome.unknown()) return resolve_unknown(outcome, now);
  ++refused_writes_;
  retry_at_ = now + kRetryInterval;
  if (outcome.refused_with(NakCode::BufferFull)) return;
  // Refused for any other reason it is not in the queue either; it may have been garbled on its way.
  if (++misunderstood_ > kMisunderstood) fail_in_motion(device_.text(outcome), now);
}

void SilverlodeAxis::resolve_unknown(const Outcome& outcome, HostTime now) {
  if (full_queue_would_tell(now)) {
    delivery_ = Delivery::Unknown;
    return;
  }
  fail_in_motion(device_.text(outcome) +
                     ". Whether the segment is in the drive's queue cannot be known, and sent twice it would "
                     "bend the path",
                 now);
}

/// The segment of unknown fate fills the last place, and the drive begins no other segment before it has
/// answered to the repetition.
bool SilverlodeAxis::full_queue_would_tell(HostTime now) const {
  const auto repetition = silverlode::imw_request(
      device_.address(), std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min(),
      std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max());
  const bool started = clock_.running();
  const HostTime answered = now + 2 * line_.longest_exchange_time(repetition);
  const double next_begin = feed_.next_begin(clock_.least_elapsed(now));
  const bool fills_last_place = feed_.waiting(clock_.least_elapsed(now), started) + 1 == depth_;
  return started && fills_last_place && clock_.most_elapsed(answered) < next_begin;
}

// ---- moving
// ---------------------------------------------------------------------------------------------------------------------

void SilverlodeAxis::poll_moving(HostTime now) {
  if (auto look = std::exchange(status_.execution, std::nullopt)) take_execution(*look, now);
  if (phase_ != Phase::Moving) return;
  feed(now);
  if (phase_ != Phase::Moving) return;
  if (!feed_.all_sent() && now >= begin_) {
    const auto fill = feed_.waiting(clock_.elapsed(now), true);
    minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(fill));
  }
  watch_motion(now);
}

// The protocol has no checksum: a digit changed on the line makes another segment, and the drive acknowledges
// it. What the drive executes is held against what was sent, so that it goes unnoticed for a moment only.
void SilverlodeAxis::take_execution(const SilverlodeStatus::Execution& look, HostTime now) {
  if (look.outcome.attempts != 1 || look.ticks_left < 1) return;
  const HostTime asked = look.outcome.request_end;
  const double expected = clock_.elapsed(asked);
  const auto instant = feed_.instant_of(look.ticks_left, expected);
  const bool fits =
      instant && std::abs(instant->elapsed - expected) <= kPlausible &&
      look.acceleration.value_or(instant->segment.acceleration) == instant->segment.acceleration &&
      look.velocity.value_or(instant->segment.velocity) == instant->segment.velocity;
  if (fits) {
    misfits_ = 0;
    return learn_clock(asked, instant->elapsed);
  }
  if (++misfits_ < kMisfits) return;
  fail_in_motion(
      fmt::format("the drive executes a segment that was not sent for {:.3f} s of its motion ({} ticks left, "
                  "acceleration {}, velocity {}): a segment was changed or lost on the line",
                  expected, look.ticks_left, look.acceleration.value_or(0), look.velocity.value_or(0)),
      now);
}

/// Register 18 tells how far the drive has played, at some instant between the end of the command and its
/// execution.
void SilverlodeAxis::learn_clock(HostTime asked, double elapsed) {
  clock_.observe_less_than(asked, elapsed + tick());
  clock_.observe_at_least(asked + parameters_.execution_time, elapsed);
  clock_error_ppm_ = clock_.error_ppm();
}

void SilverlodeAxis::watch_motion(HostTime now) {
  if (!status_.silence.empty())
    return fail_in_motion(fmt::format("the drive does not answer ({})", std::exchange(status_.silence, {})),
                          now);
  if (status_.io.fault() && status_.io_time > clock_.start_time())
    return fail_in_motion("the drive reports: " + status_.io.text(), now);
  const bool looked = status_.io_time > clock_.start_time();
  if (looked && !status_.io.trajectory_active()) return end_of_motion(now);
  if (now - std::max(feedback().time, clock_.start_time()) > parameters_.feedback_timeout) {
    return fail_in_motion(
        fmt::format("no position has come from the drive for {:.2f} s", seconds(now - feedback().time)), now);
  }
  if (clock_.least_elapsed(now) > feed_.duration() + seconds(kOvertime)) {
    fail_in_motion(
        fmt::format("the drive still moves {:.1f} s after the end of its segments", seconds(kOvertime)), now);
  }
}

void SilverlodeAxis::end_of_motion(HostTime now) {
  if (!feed_.all_sent() ||
      clock_.most_elapsed(status_.io_time) + seconds(parameters_.execution_time) < feed_.duration()) {
    ++underruns_;
    return fail_in_motion(fmt::format("the drive left the interpolated motion {:.3f} s after the start "
                                      "instead of {:.3f} s: its queue ran "
                                      "dry, or something has stopped it",
                                      clock_.elapsed(status_.io_time), feed_.duration()),
                          now);
  }
  enter(Phase::Ending, now);
  sequence_.start({read_rest(), read_position()}, now);
}

// The drive's own target tells whether it has gone all of the way.
void SilverlodeAxis::poll_ending(HostTime now) {
  if (!sequence_done(now)) return;
  if (rest_counts_ != feed_.final_counts()) {
    return fail(
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

GoalTime SilverlodeAxis::playback(HostTime when) const {
  if (!feed_.loaded()) return GoalTime{0.0};
  if (clock_.running() && second_wait_made_) return feed_.goal_time_at(clock_.elapsed(when));
  if (finished_) return feed_.path().end_time() + GoalTime{seconds(when - phase_since_)};
  return feed_.path().start_time() - GoalTime{parameters_.start_lead};
}

// ---- stopping
// ---------------------------------------------------------------------------------------------------------------------

void SilverlodeAxis::stop(HostTime now) {
  if (device_.withdraw_bulk()) segment_id_ = silverlode::kNoRequest;
  switch (phase_) {
    case Phase::Starting:
    case Phase::Moving:
      delivery_ = Delivery::None;
      enter(Phase::Braking, now);
      return start_braking(now);
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Loaded:
      delivery_ = Delivery::None;
      enter(Phase::Emptying, now);
      return sequence_.start({{silverlode::imq_request(device_.address()), {}}, read_rest(), read_position()},
                             now);
    default:
      return;
  }
}

/// STP ends the interpolated motion on a ramp; what is left in the queue goes once the drive stands.
void SilverlodeAxis::start_braking(HostTime now) {
  const std::uint8_t address = device_.address();
  sequence_.start({{silverlode::stp_request(address, stop_deceleration()), {}},
                   await_rest(kLooksAtStop),
                   {silverlode::imq_request(address), {}},
                   read_rest(),
                   read_position()},
                  now);
}

void SilverlodeAxis::poll_braking(HostTime now) {
  if (!sequence_done(now)) return;
  clock_.stop();
  enter(Phase::Ready, now);
}

/// The host has found a fault while the drive may be moving: it is told to stop on its ramp.
void SilverlodeAxis::fail_in_motion(const std::string& reason, HostTime now) {
  fail(reason, now);
  clock_.stop();
  device_.request(silverlode::stp_request(device_.address(), stop_deceleration()));
}

}  // namespace interpolated_motion::axis
