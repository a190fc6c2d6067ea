#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace interpolated_motion::silverlode {
namespace {

constexpr std::size_t kBroadcastCapacity = 8;

LineParameters checked(const std::string& line_name, const LineParameters& parameters) {
  check(line_name, parameters);
  return parameters;
}

}  // namespace

LineMaster::LineMaster(std::string line_name, LineParameters parameters)
    : line_name_(std::move(line_name)),
      parameters_(checked(line_name_, parameters)),
      broadcasts_(kBroadcastCapacity) {}

LineMaster::~LineMaster() = default;

DeviceLink& LineMaster::add_device(std::uint8_t address) {
  if (address < 1 || address > kMaxAddress) {
    throw std::invalid_argument(
        fmt::format("{}: address {} is not in 1..{}", line_name_, address, kMaxAddress));
  }
  if (devices_[address]) {
    throw std::invalid_argument(fmt::format("{}: address {} is used twice", line_name_, address));
  }
  devices_[address].reset(new DeviceLink(*this, address, parameters_.request_capacity));
  in_order_.push_back(devices_[address].get());
  return *devices_[address];
}

void LineMaster::advance(HostTime now) { now_ = std::max(now_, now); }

void LineMaster::poll(HostTime now) {
  advance(now);
  if (exchange_ && now >= exchange_->reply_deadline) on_timeout();
}

HostTime LineMaster::next_deadline() const {
  if (exchange_) return exchange_->reply_deadline;
  return free_at_ > now_ && something_waits() ? free_at_ : kNever;
}

bool LineMaster::something_waits() const {
  return !broadcasts_.empty() ||
         std::any_of(in_order_.begin(), in_order_.end(), [](const DeviceLink* device) {
           return device->control_waits() || device->bulk_waits();
         });
}

bool LineMaster::bulk_waits() const {
  return std::any_of(in_order_.begin(), in_order_.end(),
                     [](const DeviceLink* device) { return device->bulk_waits(); });
}

std::optional<std::string_view> LineMaster::peek_outgoing(HostTime now) {
  advance(now);
  peeked_ = Peeked::None;
  if (exchange_ || now < free_at_) return std::nullopt;
  choose_next();
  switch (peeked_) {
    case Peeked::Broadcast:
      return broadcasts_.front().request.text.view();
    case Peeked::Control:
      return peeked_device_->next_control().request.text.view();
    case Peeked::Bulk:
      return peeked_device_->bulk_->waiting.request.text.view();
    case Peeked::None:
      break;
  }
  return std::nullopt;
}

void LineMaster::pop_outgoing(HostTime now) {
  advance(now);
  const Peeked popped = peeked_;
  peeked_ = Peeked::None;
  switch (popped) {
    case Peeked::Broadcast:
      return send_broadcast(now);
    case Peeked::Control:
      pass_on(control_turn_);
      return begin_exchange(*peeked_device_, peeked_device_->take_control(), now);
    case Peeked::Bulk:
      pass_on(bulk_turn_);
      return begin_exchange(*peeked_device_, peeked_device_->take_bulk(), now);
    case Peeked::None:
      break;
  }
}

void LineMaster::pass_on(std::size_t& turn) const { turn = (turn + 1) % in_order_.size(); }

void LineMaster::choose_next() {
  if (!broadcasts_.empty()) {
    peeked_ = Peeked::Broadcast;
    return;
  }
  const std::optional<std::size_t> control = next_control_device();
  const std::optional<std::size_t> bulk = next_bulk_device();
  if (!control && !bulk) return;
  const bool bulk_goes = bulk && (!control || bulk_first_);
  peeked_ = bulk_goes ? Peeked::Bulk : Peeked::Control;
  std::size_t& turn = bulk_goes ? bulk_turn_ : control_turn_;
  turn = bulk_goes ? *bulk : *control;
  peeked_device_ = in_order_[turn];
}

std::optional<std::size_t> LineMaster::next_control_device() const {
  for (std::size_t i = 0; i < in_order_.size(); ++i) {
    const std::size_t index = (control_turn_ + i) % in_order_.size();
    if (in_order_[index]->control_waits()) return index;
  }
  return std::nullopt;
}

/// Bulk requests wait for the control requests of their own device, whatever the order among devices: an IMQ
/// behind the IMW it was queued before would clear it.
std::optional<std::size_t> LineMaster::next_bulk_device() const {
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < in_order_.size(); ++i) {
    const std::size_t index = (bulk_turn_ + i) % in_order_.size();
    const DeviceLink& device = *in_order_[index];
    if (!device.bulk_waits() || device.control_waits()) continue;
    if (!next || device.bulk_->deadline < in_order_[*next]->bulk_->deadline) next = index;
  }
  return next;
}

RequestId LineMaster::broadcast(const Request& request) {
  if (request.address != kGlobalAddress || !request.text.complete()) return kNoRequest;
  if (!broadcasts_.push({last_broadcast_ + 1, request})) return kNoRequest;
  return ++last_broadcast_;
}

std::optional<HostTime> LineMaster::broadcast_end(RequestId id) const {
  if (id == kNoRequest || id != sent_broadcast_.id) return std::nullopt;
  return sent_broadcast_.end;
}

void LineMaster::clear_outgoing() {
  broadcasts_.clear();
  for (DeviceLink* device : in_order_) device->drop_requests();
}

void LineMaster::do_not_repeat(const DeviceLink& device) {
  if (exchange_ && exchange_->device == &device) exchange_->may_repeat = false;
}

HostDuration LineMaster::characters_time(std::size_t characters) const {
  const std::int64_t bits = static_cast<std::int64_t>(characters) * parameters_.bits_per_character;
  return HostDuration(bits * 1'000'000'000 / parameters_.baud);
}

HostDuration LineMaster::exchange_time(const Request& request) const {
  const HostDuration out = characters_time(request.text.length());
  if (request.reply == ReplyKind::None) return out + parameters_.guard;
  return out + parameters_.turnaround + characters_time(reply_characters(request)) + parameters_.pause;
}

HostDuration LineMaster::longest_exchange_time(const Request& request) const {
  const HostDuration out = characters_time(request.text.length());
  if (request.reply == ReplyKind::None) return out + parameters_.guard;
  return out + parameters_.reply_timeout + characters_time(longest_reply_characters(request)) +
         std::max(parameters_.guard, parameters_.pause);
}

double LineMaster::load(HostTime now) const {
  if (!exchange_) return load_.load(now);
  LineLoad load = load_;
  load.add(exchange_->begin, now);
  return load.load(now);
}

HostDuration real_exchange_time(const LineMaster& line, const Request& request) {
  constexpr HostDuration kStep = std::chrono::microseconds(500);
  const HostDuration usual = line.exchange_time(request);
  if (request.reply == ReplyKind::None) return usual;
  const HostDuration seen = (line.reply_delay() + kStep - HostDuration(1)) / kStep * kStep;
  return usual + std::max(seen - line.parameters().turnaround, HostDuration::zero());
}

}  // namespace interpolated_motion::silverlode
