#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

// From a path to a drive that plays it: planning, loading, and the common start.

using namespace std::chrono_literals;
namespace registers = silverlode::registers;
using silverlode::Outcome;

namespace {

/// Longest for one segment to get over the line before the motion.
constexpr HostDuration kFillTimeout = 5s;
/// Of the lead, the part that the first segment of waiting takes; the second one takes the rest.
constexpr double kFirstWait = 0.5;
/// Share of the lead that may be gone when the axis is told the begin.
constexpr double kLatestTold = 0.3;

}  // namespace

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
  const auto shortest = static_cast<std::int64_t>(std::ceil(delivery_->shortest_segment() / tick()));
  encoding.min_segment_ticks = std::max(encoding.min_segment_ticks, shortest);
  return encoding;
}

std::optional<Refusal> SilverlodeAxis::plan(const trajectory::Path& path, GoalTime) {
  const auto stream = encoding::encode_ims(path, encoding(), rest_counts_);
  if (!stream) return stream.error();
  planned_path_ = path;
  planned_slots_ = slots_of(stream.value(), path.start_time());
  planned_origin_.reset();
  return std::nullopt;
}

// A segment must be there when the one before it has been executed.
std::vector<RecordSlot> SilverlodeAxis::slots_of(const encoding::ImsStream& stream, GoalTime start) const {
  std::vector<double> begins{0.0};
  for (const ImsSegment& segment : stream.segments) begins.push_back(begins.back() + segment.time * tick());
  std::vector<RecordSlot> slots = delivery_->slots(begins, parameters_.commit_horizon);
  for (RecordSlot& slot : slots) {
    slot.release += start;
    slot.deadline += start;
  }
  return slots;
}

void SilverlodeAxis::load(HostTime now) {
  stream_origin_ = planned_origin_;
  stream_begin_ = GoalTime{0.0};
  feed_.load(planned_path_, stream_origin_ ? stream_encoding() : encoding(), rest_counts_,
             delivery_->capacity());
  feed_.wait(std::llround(kFirstWait * parameters_.start_lead / tick()));
  finished_ = false;
  begin_ = kNever;
  second_wait_made_ = false;
  delivery_->begin();
  misfits_ = 0;
  clock_.stop();
  underruns_at_load_ = underruns_;
  refused_at_load_ = delivery_->refused_writes();
  enter_phase(Phase::Clearing, now);
  auto steps = clear_status();
  for (auto& step : delivery_->clear_steps()) steps.push_back(std::move(step));
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
  enter_phase(Phase::Filling, now);
}

void SilverlodeAxis::poll_filling(HostTime now) {
  if (delivery_->delivered() == 1) {
    minimum_fill_ = static_cast<std::uint32_t>(delivery_->capacity());
    return enter_phase(Phase::Loaded, now);
  }
  offer(feed_.sent() == 0, now);
  if (phase() == Phase::Filling && expired(now, kFillTimeout))
    fail("its first segment does not get over the line: is the line overloaded or down?", now);
}

void SilverlodeAxis::arm(HostTime begin, HostTime now) {
  if (phase() != Phase::Loaded) return;
  if (seconds(begin - now) < (1.0 - kLatestTold) * parameters_.start_lead) {
    return fail(
        fmt::format("it was told {:.3f} s before the common start that it needs to know {:.3f} s before: the "
                    "host has stalled",
                    seconds(begin - now), parameters_.start_lead),
        now);
  }
  begin_ = begin;
  if (stream_origin_) stream_begin_ = GoalTime{seconds(begin - *stream_origin_)};
  enter_phase(Phase::Starting, now);
  if (common_start_ != nullptr) return common_start_->ask(start_member_);
  start_id_ = device_.request(silverlode::ims_request(device_.address(), parameters_.ims_arguments));
}

void SilverlodeAxis::withdraw_start() {
  if (common_start_ != nullptr) common_start_->withdraw(start_member_);
}

// Without an answer to IMS it is not known whether the drive has begun; it only waits so far, so it is
// stopped.
void SilverlodeAxis::take_start(const Outcome& outcome, HostTime now) {
  if (phase() != Phase::Starting) return;
  if (!outcome.accepted()) return fail(device_.text(outcome), now);
  clock_.start(outcome.request_end + parameters_.execution_time / 2);
  begin_motion(now);
}

void SilverlodeAxis::poll_starting(HostTime now) {
  if (expired(now, kFillTimeout)) return fail("IMS does not get over the line", now);
  const auto sent = common_start_ != nullptr ? common_start_->sent() : std::nullopt;
  if (!sent) return;
  clock_.start(*sent + parameters_.execution_time / 2);
  enter_phase(Phase::Verifying, now);
  sequence_.start({check_begun()}, now);
}

// A command to all drives is not answered: whether this one has heard and obeyed it shows in what it does.
CommandSequence::Step SilverlodeAxis::check_begun() {
  return {silverlode::rio_request(device_.address()),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (!outcome.accepted()) return device_.text(outcome);
            if (silverlode::IoStatus{outcome.word().value_or(0)}.trajectory_active()) return std::nullopt;
            return fmt::format(
                "the drive has not started at {}. If it never does, set `start` of the bus to "
                "`addressed`",
                common_start_->text());
          }};
}

void SilverlodeAxis::poll_verifying(HostTime now) {
  if (sequence_.state() == CommandSequence::State::Failed) return fail(sequence_.failure(), now);
  if (sequence_.state() == CommandSequence::State::Done) begin_motion(now);
}

void SilverlodeAxis::begin_motion(HostTime now) {
  enter_phase(Phase::Moving, now);
  make_second_wait(now);
}

/// The waiting that is left until the path begins, by what the drive's clock is known to do.
void SilverlodeAxis::make_second_wait(HostTime now) {
  const double until_begin = seconds(begin_ - clock_.start_time()) * drive_rate();
  const auto ticks = std::llround((until_begin - feed_.queue_end()) / tick());
  if (ticks < 1) return fail("the start command came too late for the common start", now);
  feed_.wait(ticks);
  second_wait_made_ = true;
}

}  // namespace interpolated_motion::axis
