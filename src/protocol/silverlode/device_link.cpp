#include "interpolated_motion_driver/protocol/silverlode/device_link.h"

#include <fmt/format.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::silverlode {
namespace {

/// Noise garbles a reply now and then; so many in a row have another reason.
constexpr std::uint64_t kManyGarbledReplies = 3;

std::string words_text(const Outcome& outcome) {
  std::string text;
  for (std::size_t i = 0; i < outcome.word_count; ++i) text += fmt::format(" {:04X}", outcome.words[i]);
  return text;
}

std::string attempts_text(const Outcome& outcome) {
  return outcome.attempts > 1 ? fmt::format(" to {} attempts", outcome.attempts) : "";
}

std::string no_reply_text(const Outcome& outcome) {
  std::string text = "no reply" + attempts_text(outcome);
  if (outcome.received.empty()) return text;
  return fmt::format("{}, but \"{}\" came", text, outcome.received.printable());
}

std::string result_text(const Outcome& outcome) {
  switch (outcome.kind) {
    case OutcomeKind::Acknowledged:
      return "acknowledged";
    case OutcomeKind::Data:
      return "answered" + words_text(outcome);
    case OutcomeKind::Refused:
      return fmt::format("refused, NAK {} ({})", static_cast<unsigned>(outcome.nak),
                         std::string(to_text(outcome.nak)));
    case OutcomeKind::NoReply:
      return no_reply_text(outcome);
    case OutcomeKind::Garbled:
      return fmt::format("garbled reply \"{}\"{}", outcome.received.printable(), attempts_text(outcome));
    case OutcomeKind::Sent:
      return "sent";
    case OutcomeKind::Dropped:
      return "dropped before it was sent";
  }
  return "";
}

}  // namespace

DeviceLink::DeviceLink(LineMaster& master, std::uint8_t address, std::size_t capacity)
    : master_(master), address_(address), control_(capacity), outcomes_(capacity) {}

std::string DeviceLink::name() const { return fmt::format("{} address {}", master_.line_name(), address_); }

RequestId DeviceLink::request(const Request& request) {
  if (!can_take(request)) return kNoRequest;
  control_.push({++last_id_, request, 0});
  return last_id_;
}

RequestId DeviceLink::offer_bulk(const Request& request, HostTime deadline) {
  if (bulk_ || !can_take(request)) return kNoRequest;
  bulk_ = Bulk{{++last_id_, request, 0}, deadline};
  return last_id_;
}

bool DeviceLink::withdraw_bulk() {
  const bool waited = bulk_.has_value();
  bulk_.reset();
  return waited;
}

void DeviceLink::drop_requests() {
  if (repeat_) give_up_repeat();
  while (!control_.empty()) finish_unsent(*control_.take());
  if (bulk_) finish_unsent(take_bulk());
  master_.do_not_repeat(*this);
}

std::size_t DeviceLink::pending() const {
  return control_.size() + (repeat_ ? 1u : 0u) + (bulk_ ? 1u : 0u) + (on_line_ ? 1u : 0u);
}

bool DeviceLink::can_take(const Request& request) const {
  return request.address == address_ && request.text.complete() &&
         pending() + outcomes_.size() < outcomes_.capacity();
}

DeviceLink::Waiting DeviceLink::take_control() {
  if (!repeat_) return *control_.take();
  const Waiting waiting = *repeat_;
  repeat_.reset();
  return waiting;
}

DeviceLink::Waiting DeviceLink::take_bulk() {
  const Waiting waiting = bulk_->waiting;
  bulk_.reset();
  return waiting;
}

void DeviceLink::give_up_repeat() {
  repeat_.reset();
  outcomes_.push(failure_);
}

void DeviceLink::finish_unsent(const Waiting& waiting) {
  Outcome outcome;
  outcome.id = waiting.id;
  outcome.request = waiting.request;
  outcome.kind = OutcomeKind::Dropped;
  outcomes_.push(outcome);
}

void DeviceLink::count(const Outcome& outcome) {
  switch (outcome.kind) {
    case OutcomeKind::Acknowledged:
      ++statistics_.acknowledged;
      break;
    case OutcomeKind::Data:
      ++statistics_.data;
      break;
    case OutcomeKind::Refused: {
      const auto code = static_cast<std::uint16_t>(outcome.nak);
      ++statistics_.refused[code <= kMaxNakCode ? code : 0];
      break;
    }
    case OutcomeKind::NoReply:
      ++statistics_.timeouts;
      ++statistics_.timeouts_in_a_row;
      break;
    case OutcomeKind::Garbled:
      ++statistics_.garbled;
      ++statistics_.garbled_in_a_row;
      break;
    case OutcomeKind::Sent:
    case OutcomeKind::Dropped:
      break;
  }
  if (!outcome.accepted() && outcome.kind != OutcomeKind::Refused) return;
  statistics_.garbled_in_a_row = 0;
  statistics_.timeouts_in_a_row = 0;
  statistics_.late_by = HostDuration::zero();
}

std::string DeviceLink::cause_text(const Outcome& outcome) const {
  const LinkStatistics& known = statistics_;
  const std::string& line = master_.line_name();
  if (outcome.unknown() && known.late_by > HostDuration::zero()) {
    return fmt::format(
        "; a reply came {:.3f} s after its request, too late by `reply_timeout` ({:.3f} s): raise "
        "buses/{}/reply_timeout",
        seconds(known.late_by), seconds(master_.parameters().reply_timeout), line);
  }
  if (outcome.kind != OutcomeKind::Garbled || known.garbled_in_a_row < kManyGarbledReplies) return {};
  const bool alone = master_.device_count() == 1;
  const bool noise = std::any_of(
      master_.in_order_.begin(), master_.in_order_.end(),
      [this](const DeviceLink* other) { return other != this && other->statistics_.garbled_in_a_row > 0; });
  return fmt::format(
      "; {} replies in a row were garbled{}", known.garbled_in_a_row,
      alone   ? fmt::format(": noise, another rate than buses/{}/baud, or two drives share "
                              "address {}",
                            line, address_)
      : noise ? fmt::format(", those of other addresses too: noise (shield, ground, "
                            "termination), or another rate than buses/{}/baud",
                            line)
              : fmt::format(" and none of other addresses: two drives may share address {}", address_));
}

std::string DeviceLink::text(const Outcome& outcome) const {
  return fmt::format("{}: {} \"{}\" {}{}", name(), std::string(mnemonic(outcome.request.command)),
                     outcome.request.text.printable(), result_text(outcome), cause_text(outcome));
}

}  // namespace interpolated_motion::silverlode
