// What happens on the line: an exchange begins, is answered, fails; lines nobody waits for.

#include <fmt/format.h>

#include <algorithm>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::silverlode {
namespace {

/// Silence is awaited so many times `guard` at most: a line that never falls silent must not keep a stop from
/// being sent.
constexpr int kLongestNoise = 10;

/// POR is answered with the echo of POL by some drives.
bool is_echo_of(std::uint16_t echo, Command command) {
  if (echo == static_cast<std::uint16_t>(command)) return true;
  return command == Command::POR && echo == static_cast<std::uint16_t>(Command::POL);
}

bool is_answer(const Reply& reply, const Request& request) {
  switch (reply.type) {
    case ReplyType::Ack:
      return request.reply == ReplyKind::Ack || request.reply == ReplyKind::AckOrData;
    case ReplyType::Nak:
      return is_echo_of(reply.command, request.command);
    case ReplyType::Data:
      break;
  }
  const bool expected = request.reply == ReplyKind::Data || request.reply == ReplyKind::AckOrData;
  return expected && is_echo_of(reply.command, request.command) &&
         (request.reply_words == 0 || request.reply_words == reply.word_count);
}

OutcomeKind outcome_kind(ReplyType type) {
  switch (type) {
    case ReplyType::Ack:
      return OutcomeKind::Acknowledged;
    case ReplyType::Data:
      return OutcomeKind::Data;
    case ReplyType::Nak:
      break;
  }
  return OutcomeKind::Refused;
}

const char* name_of(UnexpectedLine cause) {
  switch (cause) {
    case UnexpectedLine::NoRequest:
      return "a reply that no request waits for";
    case UnexpectedLine::WrongAddress:
      return "a reply of another address than the one asked";
    case UnexpectedLine::WrongEcho:
      return "a reply to another request than the one sent";
    case UnexpectedLine::Malformed:
      return "a line that is no reply";
    case UnexpectedLine::Truncated:
      break;
  }
  return "a line without its end";
}

/// A reply that nobody waits for any more: to the request before, which was given up or was `answered`.
void note_stray(LinkStatistics& statistics, bool answered, HostDuration late_by) {
  if (answered) {
    ++statistics.second_replies;
  } else {
    statistics.late_by = std::max(late_by, HostDuration(1));
  }
}

}  // namespace

void LineMaster::begin_exchange(DeviceLink& device, DeviceLink::Waiting waiting, HostTime now) {
  ++waiting.attempts;
  ++device.statistics_.sent;
  if (waiting.attempts > 1) ++device.statistics_.repeats;
  device.on_line_ = true;
  bulk_first_ = false;
  last_.sent = waiting.request.text;
  parser_.reset();

  Exchange exchange;
  exchange.device = &device;
  exchange.sent = waiting;
  exchange.begin = now;
  exchange.request_end = now + characters_time(waiting.request.text.length());
  exchange.reply_deadline = exchange.request_end + parameters_.reply_timeout +
                            characters_time(longest_reply_characters(waiting.request));
  exchange_ = exchange;
  if (waiting.request.reply == ReplyKind::None) end_unanswered();
}

void LineMaster::end_unanswered() {
  DeviceLink& device = *exchange_->device;
  device.outcomes_.push(make_outcome(OutcomeKind::Sent, exchange_->request_end));
  end_exchange(exchange_->request_end, parameters_.guard);
}

void LineMaster::send_broadcast(HostTime now) {
  const Broadcast broadcast = *broadcasts_.take();
  last_.sent = broadcast.request.text;
  parser_.reset();
  sent_broadcast_ = {broadcast.id, now + characters_time(broadcast.request.text.length())};
  free_at_ = sent_broadcast_.end + parameters_.guard;
  load_.add(now, free_at_);
}

void LineMaster::on_character(char c, HostTime time) {
  advance(time);
  if (!exchange_) await_silence(time);
  switch (parser_.on_character(c, time)) {
    case Parsed::Nothing:
      break;
    case Parsed::Echo:
      ++echoes_;
      break;
    case Parsed::Malformed:
      on_malformed(time);
      break;
    case Parsed::Reply:
      on_reply(parser_.reply());
      break;
  }
}

void LineMaster::await_silence(HostTime time) {
  if (time - noise_end_ >= parameters_.guard) noise_begin_ = time;
  noise_end_ = time;
  const HostTime longest = noise_begin_ + kLongestNoise * parameters_.guard;
  free_at_ = std::max(free_at_, std::min(time + parameters_.guard, longest));
}

void LineMaster::on_reply(const Reply& reply) {
  if (!exchange_) {
    const HostTime begin = reply.end - characters_time(parser_.line().length() + 1);
    if (last_.device != nullptr && last_.device->address() == reply.address)
      note_stray(last_.device->statistics_, last_.answered, begin - last_.request_end);
    return count(UnexpectedLine::NoRequest, reply.end);
  }
  const Request& request = exchange_->sent.request;
  if (reply.address != request.address) return ignore_line(UnexpectedLine::WrongAddress, reply.end);
  if (!is_answer(reply, request)) return ignore_line(UnexpectedLine::WrongEcho, reply.end);

  Outcome outcome = make_outcome(outcome_kind(reply.type), reply.end);
  outcome.reply_begin = reply.end - characters_time(parser_.line().length() + 1);
  outcome.word_count = reply.word_count;
  outcome.words = reply.words;
  outcome.nak = reply.nak;
  DeviceLink& device = *exchange_->device;
  device.count(outcome);
  device.outcomes_.push(outcome);
  reply_delay_.add(std::max(outcome.reply_begin - exchange_->request_end, HostDuration(0)));
  last_ = {last_.sent, &device, exchange_->request_end, true};
  end_exchange(std::max(reply.end, exchange_->request_end), parameters_.pause);
}

void LineMaster::ignore_line(UnexpectedLine cause, HostTime time) {
  count(cause, time);
  exchange_->other = parser_.line();
}

void LineMaster::on_malformed(HostTime time) {
  count(UnexpectedLine::Malformed, time);
  if (exchange_) fail_attempt(OutcomeKind::Garbled, parser_.line(), time);
}

void LineMaster::on_timeout() {
  if (!parser_.in_line()) return fail_attempt(OutcomeKind::NoReply, exchange_->other, now_);
  count(UnexpectedLine::Truncated, now_);
  const LineText received = parser_.line();
  parser_.reset();
  fail_attempt(OutcomeKind::Garbled, received, now_);
}

void LineMaster::fail_attempt(OutcomeKind kind, const LineText& received, HostTime time) {
  Outcome outcome = make_outcome(kind, time);
  outcome.received = received;
  DeviceLink& device = *exchange_->device;
  device.count(outcome);
  const DeviceLink::Waiting sent = exchange_->sent;
  const bool repeat =
      exchange_->may_repeat && sent.request.repeatable && sent.attempts <= parameters_.repeats;
  last_ = {last_.sent, &device, exchange_->request_end, false};
  const bool waits = sent.request.patient && kind == OutcomeKind::NoReply;
  end_exchange(
      std::max(time, exchange_->request_end),
      waits ? std::max(kLateReplies * parameters_.reply_timeout, parameters_.guard) : parameters_.guard);
  bulk_first_ = sent.request.repeatable;
  if (!repeat) {
    device.outcomes_.push(outcome);
    return;
  }
  device.repeat_ = sent;
  device.failure_ = outcome;
}

void LineMaster::end_exchange(HostTime time, HostDuration silence) {
  free_at_ = std::max(free_at_, time + silence);
  load_.add(exchange_->begin, free_at_);
  exchange_->device->on_line_ = false;
  exchange_.reset();
}

Outcome LineMaster::make_outcome(OutcomeKind kind, HostTime time) const {
  Outcome outcome;
  outcome.id = exchange_->sent.id;
  outcome.request = exchange_->sent.request;
  outcome.kind = kind;
  outcome.attempts = exchange_->sent.attempts;
  outcome.request_end = exchange_->request_end;
  outcome.reply_begin = outcome.reply_end = time;
  return outcome;
}

void LineMaster::count(UnexpectedLine cause, HostTime time) {
  UnexpectedLines& lines = unexpected_[static_cast<std::size_t>(cause)];
  ++lines.count;
  lines.last = parser_.line();
  lines.sent = last_.sent;
  lines.time = time;
}

const UnexpectedLines& LineMaster::unexpected(UnexpectedLine cause) const {
  return unexpected_[static_cast<std::size_t>(cause)];
}

std::string LineMaster::unexpected_text(UnexpectedLine cause) const {
  const UnexpectedLines& lines = unexpected(cause);
  if (lines.count == 0) return {};
  const std::string often = lines.count == 1 ? "once" : fmt::format("{} times", lines.count);
  const std::string sent = lines.sent.empty() ? "" : fmt::format(" after \"{}\"", lines.sent.printable());
  return fmt::format("{}: {} came {}, last \"{}\"{}", line_name_, name_of(cause), often,
                     lines.last.printable(), sent);
}

}  // namespace interpolated_motion::silverlode
