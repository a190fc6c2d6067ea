#include "interpolated_motion_driver/axis/silverlode/queue_delivery.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace registers = silverlode::registers;
using silverlode::NakCode;
using silverlode::Outcome;

namespace {

/// More than any revision's queue holds.
constexpr std::size_t kDeepestQueue = 16;
/// After a queue was full that should not have been, the clock of the drive may be a little off.
constexpr HostDuration kRetryInterval = 5ms;
/// From the time a place is known to be free until the axis is polled in motion and the line is told, at
/// most.
constexpr double kNotice = 6e-3;
/// Times in a row that a drive may refuse a segment as unreadable.
constexpr int kMisunderstood = 3;

/// Time of up to 5 digits, position and velocity of 10, acceleration of 7: more than that is not physical.
silverlode::Request longest_segment() {
  return silverlode::imw_request(silverlode::kMaxAddress, 65536, std::numeric_limits<std::int32_t>::min(),
                                 1 << 23, std::numeric_limits<std::int32_t>::max());
}

}  // namespace

QueueDelivery::QueueDelivery(const DeliveryContext& context, std::size_t depth)
    : SegmentDelivery(context), measures_depth_(depth == 0), depth_(depth) {}

std::string QueueDelivery::description() const { return fmt::format("queue of {} segments", depth_); }

SegmentDelivery::Steps QueueDelivery::bring_up_steps() {
  Steps steps =
      write_and_verify(device(), registers::kImsControl, 0, "interpolated motion is fed through the queue");
  for (auto& step : measure_depth()) steps.push_back(std::move(step));
  return steps;
}

SegmentDelivery::Steps QueueDelivery::clear_steps() { return {{silverlode::imq_request(address()), {}}}; }

/// Fills the queue, which nothing executes without IMS, until the drive says that it is full, and empties it
/// again: with the depth known, "full" is no surprise later, and tells whether a segment whose ACK was lost
/// is in.
SegmentDelivery::Steps QueueDelivery::measure_depth() {
  Steps steps = clear_steps();
  if (!measures_depth_) return steps;
  depth_ = 0;
  steps.push_back(try_one_more());
  for (auto& step : clear_steps()) steps.push_back(std::move(step));
  return steps;
}

CommandSequence::Step QueueDelivery::try_one_more() {
  return {silverlode::imw_request(address(), 0, 0, 0, 0),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (outcome.refused_with(NakCode::BufferFull) && depth_ > 0) return std::nullopt;
            if (!outcome.accepted()) return device().text(outcome);
            if (++depth_ > kDeepestQueue) {
              return fmt::format(
                  "its queue takes more than {} segments (IMW); set queue_depth if that is right",
                  kDeepestQueue);
            }
            sequence().insert({try_one_more()});
            return std::nullopt;
          }};
}

double QueueDelivery::segment_time(const silverlode::LineMaster& line) {
  return seconds(line.exchange_time(longest_segment()));
}

double QueueDelivery::record_time() const {
  return seconds(silverlode::real_exchange_time(line(), longest_segment()));
}

// A segment's place becomes free when the drive begins the segment `depth_` before it.
SegmentDelivery::SlotRule QueueDelivery::slot_rule(double horizon) const {
  return [horizon, depth = depth_](const std::vector<double>& begins) {
    std::vector<RecordSlot> slots(begins.size());
    for (std::size_t i = 0; i < begins.size(); ++i) {
      const double place_free = i < depth ? 0.0 : begins[i - depth] + kNotice;
      const double release = std::max(place_free, wanted_at(begins, i, horizon));
      slots[i] = {GoalTime{release}, GoalTime{begins[i]}};
    }
    return slots;
  };
}

void QueueDelivery::begin() {
  fate_ = Fate::None;
  misunderstood_ = 0;
}

void QueueDelivery::give_up() {
  SegmentDelivery::give_up();
  fate_ = Fate::None;
}

SegmentDelivery::Failure QueueDelivery::offer(bool more, double rate, HostTime now) {
  const bool repeat = fate_ == Fate::Unknown;
  if (sending() || now < retry_at_ || !(more || repeat)) return std::nullopt;
  if (!repeat && !feed().has_place(clock().least_elapsed(now), clock().running())) return std::nullopt;
  const auto segment = feed().next(rate);
  if (!segment) return segment.error().text;
  const ImsSegment& s = segment.value();
  const HostTime deadline = clock().running() ? clock().host_time(feed().queue_end()) : now;
  if (send(silverlode::imw_request(address(), s.time, s.position, s.acceleration, s.velocity), deadline))
    fate_ = repeat ? Fate::SentAgain : Fate::Sent;
  return std::nullopt;
}

SegmentDelivery::Failure QueueDelivery::take(const Outcome& outcome, HostTime now) {
  forget_command();
  const Fate fate = std::exchange(fate_, Fate::None);
  if (outcome.kind == silverlode::OutcomeKind::Dropped || fate == Fate::None) return std::nullopt;
  const bool was_in = fate == Fate::SentAgain && outcome.refused_with(NakCode::BufferFull);
  if (outcome.accepted() || was_in) {
    feed().mark_sent();
    count_segment();
    misunderstood_ = 0;
    return std::nullopt;
  }
  if (outcome.unknown()) return resolve_unknown(outcome, now);
  return take_refusal(outcome, now);
}

/// A segment refused is not in the queue. If not for a full queue, it may have been garbled on its way.
SegmentDelivery::Failure QueueDelivery::take_refusal(const Outcome& outcome, HostTime now) {
  count_refusal();
  retry_at_ = now + kRetryInterval;
  if (outcome.refused_with(NakCode::BufferFull)) return std::nullopt;
  if (++misunderstood_ > kMisunderstood) return device().text(outcome);
  return std::nullopt;
}

SegmentDelivery::Failure QueueDelivery::resolve_unknown(const Outcome& outcome, HostTime now) {
  if (!full_queue_would_tell(now)) {
    return device().text(outcome) +
           ". Whether the segment is in the drive's queue cannot be known, and sent twice it would bend the "
           "path";
  }
  fate_ = Fate::Unknown;
  return std::nullopt;
}

/// The segment of unknown fate fills the last place, and the drive begins no other segment before it has
/// answered to the repetition.
bool QueueDelivery::full_queue_would_tell(HostTime now) const {
  constexpr auto kWidest = std::numeric_limits<std::int32_t>::max();
  const auto repetition =
      silverlode::imw_request(address(), kWidest, std::numeric_limits<std::int32_t>::min(), kWidest, kWidest);
  const bool started = clock().running();
  const HostTime answered = now + 2 * line().longest_exchange_time(repetition);
  const double next_begin = feed().next_begin(clock().least_elapsed(now));
  const bool fills_last_place = feed().waiting(clock().least_elapsed(now), started) + 1 == depth_;
  return started && fills_last_place && clock().most_elapsed(answered) < next_begin;
}

}  // namespace interpolated_motion::axis
