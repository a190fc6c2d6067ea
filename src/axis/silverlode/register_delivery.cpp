#include "interpolated_motion_driver/axis/silverlode/register_delivery.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/look_pace.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace registers = silverlode::registers;
using silverlode::decode_ims_control;
using silverlode::encode_ims_control;
using silverlode::Outcome;

namespace {

/// From the time a block may be handed over until the axis is polled and the line is told, at most.
constexpr double kNotice = 6e-3;

/// A write of a register. It is repeated here if at all, since meanwhile another one may be more urgent.
silverlode::Request write_request(std::uint8_t address, std::uint16_t number, std::int32_t value) {
  silverlode::Request request = silverlode::wri_request(address, number, value);
  request.repeatable = false;
  return request;
}

/// The write that takes the line longest.
silverlode::Request longest_write() {
  return write_request(silverlode::kMaxAddress, 199, std::numeric_limits<std::int32_t>::min());
}

silverlode::Request longest_hand_over() {
  return write_request(silverlode::kMaxAddress, registers::kImsControl, 199);
}

}  // namespace

RegisterDelivery::RegisterDelivery(const DeliveryContext& context, const SegmentRegisters& registers)
    : SegmentDelivery(context), registers_(registers) {}

std::string RegisterDelivery::description() const {
  return fmt::format("segments in registers {}..{}", registers_.first, registers_.last());
}

SegmentDelivery::Steps RegisterDelivery::bring_up_steps() {
  return write_and_verify(device(), registers::kImsControl, stale_control(),
                          "interpolated motion is fed through registers");
}

SegmentDelivery::Steps RegisterDelivery::clear_steps() {
  return {{silverlode::wri_request(address(), registers::kImsControl, stale_control()), {}}};
}

// Budget.

double RegisterDelivery::segment_time(const silverlode::LineMaster& line) {
  return static_cast<double>(kWrites) * seconds(line.exchange_time(longest_write()));
}

double RegisterDelivery::record_bus_time() const {
  return segment_time(line()) / static_cast<double>(kWrites) / line_share();
}

double RegisterDelivery::record_time() const {
  return seconds(silverlode::real_exchange_time(line(), longest_write()));
}

/// Time for the hand-over to be tried again, s.
double RegisterDelivery::reserve() const {
  return registers_.lost_replies * seconds(line().longest_exchange_time(longest_hand_over()));
}

/// Within each segment the next one is handed over, with a single block written before, while the segments of
/// all drives of the line may begin at once and a question may be under way.
double RegisterDelivery::shortest_segment() const {
  const double writes = registers_.blocks > 1 ? 1.0 : static_cast<double>(kWrites);
  const double all = static_cast<double>(line().device_count()) * writes;
  const double with_look = all * record_time() + seconds(longest_look_time(line()));
  return kNotice + reserve() + std::max(all * record_bus_time(), with_look);
}

// Five writes a segment: four into a block, which is free when the drive begins the segment that is in it,
// and the one that hands it over, when the drive begins the segment before.
SegmentDelivery::SlotRule RegisterDelivery::slot_rule(double horizon) const {
  return [horizon, blocks = registers_.blocks, reserve = reserve()](const std::vector<double>& begins) {
    std::vector<RecordSlot> slots;
    slots.reserve(kWrites * begins.size());
    for (std::size_t i = 0; i < begins.size(); ++i) {
      const double block_free = i < blocks ? 0.0 : begins[i - blocks] + kNotice;
      const double before_taken = i < 1 ? 0.0 : begins[i - 1] + kNotice;
      const GoalTime deadline{i < 1 ? 0.0 : begins[i] - reserve};
      const GoalTime wanted{std::max(block_free, wanted_at(begins, i, horizon))};
      slots.insert(slots.end(), kBlock, {wanted, deadline});
      slots.push_back({GoalTime{std::max(before_taken, wanted.count())}, deadline});
    }
    return slots;
  };
}

// Sending.

std::int32_t RegisterDelivery::control_of(std::size_t segment) const {
  return encode_ims_control({false, registers_.block_of(segment)});
}

/// What a drive has in register 17 when it has used up everything.
std::int32_t RegisterDelivery::stale_control() const { return encode_ims_control({true, registers_.first}); }

void RegisterDelivery::begin() {
  command_ = Command::None;
  filling_.reset();
  handed_over_ = 0;
  in_doubt_ = false;
  failures_ = 0;
}

void RegisterDelivery::give_up() {
  SegmentDelivery::give_up();
  begin();
}

SegmentDelivery::Failure RegisterDelivery::offer(bool more, double rate, HostTime now) {
  if (sending()) {
    withdraw_late_repetition(now);
  } else if (in_doubt_) {
    resolve_doubt(now);
  } else if (hand_over_due(now)) {
    hand_over(Command::HandOver, now);
  } else if (filling_ || (more && feed().has_place(clock().least_elapsed(now), clock().running()))) {
    return fill(rate, now);
  }
  return std::nullopt;
}

void RegisterDelivery::send_as(Command command, const silverlode::Request& request, HostTime deadline) {
  if (send(request, deadline)) command_ = command;
}

SegmentDelivery::Failure RegisterDelivery::fill(double rate, HostTime now) {
  if (!filling_) {
    const auto segment = feed().next(rate);
    if (!segment) return segment.error().text;
    const ImsSegment& s = segment.value();
    filling_ = Filling{{s.time, s.position, s.acceleration, s.velocity}, 0};
  }
  const auto number = static_cast<std::uint16_t>(registers_.block_of(feed().sent()) + filling_->written);
  const HostTime deadline = clock().running() ? clock().host_time(feed().queue_end()) : now;
  send_as(Command::Fill, write_request(address(), number, filling_->values[filling_->written]), deadline);
  return std::nullopt;
}

bool RegisterDelivery::hand_over_due(HostTime now) const {
  const std::size_t waiting = feed().waiting(clock().least_elapsed(now), clock().running());
  const std::size_t taken = feed().sent() - waiting;
  return handed_over_ < feed().sent() && handed_over_ <= taken;
}

void RegisterDelivery::hand_over(Command command, HostTime now) {
  const HostTime deadline = clock().running() ? needed_at() : now;
  send_as(command, write_request(address(), registers::kImsControl, control_of(handed_over_)), deadline);
}

/// When the drive will look for the segment after those handed over.
HostTime RegisterDelivery::needed_at() const { return clock().host_time(feed().begin_of(handed_over_)); }

/// Whether the drive cannot have taken the segment in doubt by `now` + `until_executed`.
bool RegisterDelivery::repetition_is_safe(HostDuration until_executed, HostTime now) const {
  return !clock().running() || clock().most_elapsed(now + until_executed) < feed().begin_of(handed_over_);
}

void RegisterDelivery::resolve_doubt(HostTime now) {
  const HostDuration attempt = line().longest_exchange_time(longest_hand_over());
  if (repetition_is_safe(2 * attempt, now)) return hand_over(Command::HandOverAgain, now);
  send_as(Command::Ask, silverlode::rrg_request(address(), registers::kImsControl), needed_at());
}

/// A repetition that has waited for the line too long is not sent any more.
void RegisterDelivery::withdraw_late_repetition(HostTime now) {
  if (command_ != Command::HandOverAgain || !device().bulk_waits()) return;
  if (repetition_is_safe(line().longest_exchange_time(longest_hand_over()), now)) return;
  SegmentDelivery::give_up();
  command_ = Command::None;
}

// Outcomes.

SegmentDelivery::Failure RegisterDelivery::take(const Outcome& outcome, HostTime) {
  forget_command();
  const Command command = std::exchange(command_, Command::None);
  if (outcome.kind == silverlode::OutcomeKind::Dropped || command == Command::None) return std::nullopt;
  if (!outcome.accepted()) return take_failure(command, outcome);
  failures_ = 0;
  switch (command) {
    case Command::Fill:
      take_filled();
      return std::nullopt;
    case Command::HandOver:
    case Command::HandOverAgain:
      take_handed_over();
      return std::nullopt;
    default:
      return take_control(outcome);
  }
}

/// What was refused has not been executed, and may have been garbled on its way.
SegmentDelivery::Failure RegisterDelivery::take_failure(Command command, const Outcome& outcome) {
  if (outcome.unknown() && command == Command::HandOver) in_doubt_ = true;
  if (!outcome.unknown()) count_refusal();
  if (++failures_ > line().parameters().repeats) return device().text(outcome);
  return std::nullopt;
}

void RegisterDelivery::take_filled() {
  if (++filling_->written < kBlock) return;
  filling_.reset();
  feed().mark_sent();
  count_segment();
}

void RegisterDelivery::take_handed_over() {
  in_doubt_ = false;
  ++handed_over_;
}

/// Register 17 tells whether the segment in doubt has been handed over. With a single block the low word is
/// always the same, and a high word of 1 means "taken" or "not handed over", whichever the time allows.
SegmentDelivery::Failure RegisterDelivery::take_control(const Outcome& outcome) {
  const auto value = outcome.register_value();
  if (!value) return device().text(outcome);
  const silverlode::ImsControl control = decode_ims_control(*value);
  if (control.first_register != registers_.block_of(handed_over_)) {
    in_doubt_ = false;
    return std::nullopt;
  }
  const bool same_as_before = registers_.blocks == 1 && control.segment_used;
  const double due = feed().begin_of(handed_over_);
  if (!same_as_before || clock().least_elapsed(outcome.request_end) >= due) {
    take_handed_over();
  } else if (clock().most_elapsed(outcome.reply_end) < due) {
    in_doubt_ = false;
  }
  return std::nullopt;
}

}  // namespace interpolated_motion::axis
