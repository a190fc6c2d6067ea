#include "interpolated_motion_driver/transport/socketcan_bus.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/system/system_error.hpp>

#include "can_socket.h"
#include "interpolated_motion_driver/transport/host_clock.h"
#include "socketcan_text.h"

namespace interpolated_motion::transport {
namespace {

constexpr HostDuration kPollPeriod = std::chrono::milliseconds(200);
/// The kernel does not tell when the interface's queue, full of other programs' frames, has room again. The
/// time of eight frames at 1 Mbit/s.
constexpr HostDuration kRetryPeriod = std::chrono::milliseconds(1);
/// Own frames not heard of for so long will not be: even a full queue at 10 kbit/s shows progress within 14
/// ms.
constexpr HostDuration kStuckAfter = std::chrono::seconds(1);
constexpr std::size_t kErrorReports = 64;

/// Frames of a node in the predefined connection set, and with node 0 NMT, SYNC and TIME, share the lower
/// seven bits of their identifier (CiA 301, 7.3.3).
constexpr std::uint32_t kNodeMask = 0x07F;
constexpr std::uint32_t kWholeId = 0x7FF;

std::vector<CanSocket::Filter> filters_of(const SocketcanParameters& parameters) {
  std::vector<CanSocket::Filter> filters;
  if (parameters.node_ids.empty()) return filters;
  filters.push_back({0, kNodeMask});
  for (const std::uint8_t id : parameters.node_ids) filters.push_back({id, kNodeMask});
  for (const std::uint32_t id : parameters.further_ids) filters.push_back({id, kWholeId});
  return filters;
}

}  // namespace

class SocketcanBus::Implementation {
 public:
  Implementation(boost::asio::io_context& context, SocketcanParameters wanted)
      : io(context), parameters(std::move(wanted)), filters_(filters_of(parameters)) {}

  bool send(const canopen::Frame& frame, HostTime now);
  std::optional<canopen::ReceivedFrame> receive();
  void refresh();
  void count_overflow();
  void async_wait(boost::asio::posix::stream_descriptor::wait_type what, WaitHandler handler);

  boost::asio::io_context& io;
  SocketcanParameters parameters;
  SocketcanState state = SocketcanState::Missing;
  bool changed = true;  ///< since poll_interface() told the last time
  std::string status;
  std::vector<std::string> advice;
  std::optional<CanInterface> interface;
  SocketcanCounters counters;
  std::deque<CanErrorReport> errors;
  std::optional<CanSocket> socket;
  HostTime next_poll{};
  HostTime retry_at{};
  bool blocked = false;       ///< a queue was full, and nothing has left it since
  std::size_t in_flight = 0;  ///< frames taken whose confirmation is to come
  HostTime last_progress{};   ///< of a confirmation, or of the first frame of those in flight

 private:
  void open();
  void enter(SocketcanState next, std::string text);
  void leave(SocketcanState next, std::string text);
  void on_own_frame(HostTime time);
  void on_error_frame(CanErrorReport report);
  void give_up_in_flight();
  bool hears(const canopen::Frame& frame) const;

  std::vector<CanSocket::Filter> filters_;
  std::uint32_t overflow_seen_ = 0;
};

// A kernel that cannot be asked just now, for want of a descriptor or of memory, says nothing about the
// interface.
void SocketcanBus::Implementation::refresh() {
  const auto found = read_can_interface(parameters.interface);
  const bool missing = !found && found.error() == std::errc::no_such_device;
  if (!found && !missing) {
    if (!socket) leave(SocketcanState::Unusable, unknown_text(parameters.interface, found.error()));
    return;
  }
  interface = found ? std::optional(found.value()) : std::nullopt;
  if (missing) return leave(SocketcanState::Missing, missing_text(parameters.interface));
  std::string fault = interface_fault(*interface, parameters.bitrate);
  if (!fault.empty()) return leave(SocketcanState::Unusable, std::move(fault));
  if (!interface->up) return leave(SocketcanState::Down, down_text(*interface, parameters.bitrate));
  if (!socket) open();
  if (!socket) return;
  if (interface->controller == CanControllerState::BusOff) {
    enter(SocketcanState::BusOff, bus_off_text(*interface));
  } else {
    enter(SocketcanState::Up, up_text(*interface));
  }
}

void SocketcanBus::Implementation::open() {
  try {
    socket.emplace(io, interface->index, filters_, parameters.receive_buffer, parameters.send_buffer,
                   parameters.confirmed);
  } catch (const boost::system::system_error& error) {
    return leave(SocketcanState::Unusable, open_error_text(parameters.interface, error.code()));
  }
  changed = true;
  ++counters.openings;
  overflow_seen_ = 0;
  blocked = false;
  advice = interface_advice(*interface, static_cast<std::uint32_t>(parameters.transmit_limit));
  if (socket->receive_buffer() < parameters.receive_buffer) {
    advice.push_back(
        fmt::format("the kernel limits the receive buffer to {} bytes: sudo sysctl -w net.core.rmem_max={}",
                    socket->receive_buffer() / 2, parameters.receive_buffer));
  }
}

void SocketcanBus::Implementation::enter(SocketcanState next, std::string text) {
  if (next == SocketcanState::BusOff && state != next) {
    ++counters.bus_off;
    give_up_in_flight();
  }
  changed = changed || state != next;
  state = next;
  status = std::move(text);
}

void SocketcanBus::Implementation::leave(SocketcanState next, std::string text) {
  if (socket) {
    count_overflow();
    socket.reset();
    give_up_in_flight();
    changed = true;
  }
  enter(next, std::move(text));
}

bool SocketcanBus::Implementation::hears(const canopen::Frame& frame) const {
  if (filters_.empty()) return true;
  return !frame.extended && std::any_of(filters_.begin(), filters_.end(), [&frame](const auto& filter) {
    return (frame.id & filter.mask) == (filter.id & filter.mask);
  });
}

bool SocketcanBus::Implementation::send(const canopen::Frame& frame, HostTime now) {
  if (state != SocketcanState::Up || (blocked && now < retry_at)) return false;
  if (in_flight >= parameters.transmit_limit) {
    if (now - last_progress < kStuckAfter) return false;
    give_up_in_flight();
  }
  switch (socket->send(frame)) {
    case CanSocket::SendResult::Taken:
      blocked = false;
      if (!parameters.confirmed) {
        ++counters.sent;
      } else if (hears(frame) && in_flight++ == 0) {
        last_progress = now;
      }
      return true;
    case CanSocket::SendResult::SocketFull:
      ++counters.socket_full;
      break;
    case CanSocket::SendResult::QueueFull:
      ++counters.queue_full;
      break;
    case CanSocket::SendResult::Down:
      leave(SocketcanState::Down, fmt::format("CAN interface {} went down", parameters.interface));
      refresh();
      return false;
  }
  blocked = true;
  retry_at = now + kRetryPeriod;
  return false;
}

std::optional<canopen::ReceivedFrame> SocketcanBus::Implementation::receive() {
  while (socket) {
    const auto received = socket->receive();
    if (!received) return std::nullopt;
    if (received->down) {
      // What was queued in the kernel is lost, even if the interface is up again by now.
      leave(SocketcanState::Down, fmt::format("CAN interface {} went down", parameters.interface));
      refresh();
    } else if (received->error_classes != 0) {
      CanErrorReport report = decode_can_error(received->error_classes, received->frame.frame.data);
      report.time = received->frame.time;
      on_error_frame(report);
    } else {
      if (socket->known_dropped() != overflow_seen_) count_overflow();
      if (received->frame.own) {
        on_own_frame(received->frame.time);
      } else {
        ++counters.received;
      }
      return received->frame;
    }
  }
  return std::nullopt;
}

void SocketcanBus::Implementation::on_own_frame(HostTime time) {
  ++counters.sent;
  if (in_flight > 0) --in_flight;
  blocked = false;
  last_progress = time;
}

void SocketcanBus::Implementation::on_error_frame(CanErrorReport report) {
  ++counters.error_frames;
  if (errors.size() == kErrorReports) errors.pop_front();
  errors.push_back(report);
  if (report.bus_off) {
    enter(SocketcanState::BusOff, bus_off_text(*interface));
  } else if (report.restarted) {
    enter(SocketcanState::Up, up_text(*interface));
  }
}

// Confirmations may be among the frames lost, so those in flight can no longer be told apart from those that
// have left.
void SocketcanBus::Implementation::count_overflow() {
  if (!socket) return;
  const std::uint32_t dropped = socket->dropped();
  const std::uint32_t more = dropped - overflow_seen_;
  if (more == 0) return;
  overflow_seen_ = dropped;
  counters.receive_overflow += more;
  give_up_in_flight();
}

void SocketcanBus::Implementation::give_up_in_flight() {
  counters.unconfirmed += std::exchange(in_flight, 0);
  blocked = false;
}

void SocketcanBus::Implementation::async_wait(boost::asio::posix::stream_descriptor::wait_type what,
                                              WaitHandler handler) {
  if (socket) {
    socket->descriptor().async_wait(what, std::move(handler));
  } else {
    boost::asio::post(io, [handler = std::move(handler)] { handler(boost::asio::error::not_connected); });
  }
}

SocketcanBus::SocketcanBus(boost::asio::io_context& io, SocketcanParameters parameters, HostTime now) {
  validate(parameters);
  implementation_ = std::make_unique<Implementation>(io, std::move(parameters));
  implementation_->next_poll = now + kPollPeriod;
  implementation_->refresh();
}

SocketcanBus::~SocketcanBus() = default;

bool SocketcanBus::send(const canopen::Frame& frame, HostTime now) {
  return implementation_->send(frame, now);
}

std::optional<canopen::ReceivedFrame> SocketcanBus::receive() { return implementation_->receive(); }

bool SocketcanBus::poll_interface(HostTime now) {
  Implementation& i = *implementation_;
  if (i.state != SocketcanState::Up && now >= i.next_poll) {
    i.next_poll = now + kPollPeriod;
    i.refresh();
  }
  return std::exchange(i.changed, false);
}

HostTime SocketcanBus::next_deadline() const {
  const Implementation& i = *implementation_;
  if (i.state != SocketcanState::Up) return i.next_poll;
  if (i.blocked) return i.retry_at;
  return i.in_flight < i.parameters.transmit_limit ? kNever : i.last_progress + kStuckAfter;
}

SocketcanState SocketcanBus::state() const { return implementation_->state; }

const std::string& SocketcanBus::status_text() const { return implementation_->status; }

const std::vector<std::string>& SocketcanBus::advice() const { return implementation_->advice; }

const std::optional<CanInterface>& SocketcanBus::interface() const { return implementation_->interface; }

SocketcanCounters SocketcanBus::counters() {
  implementation_->count_overflow();
  return implementation_->counters;
}

std::optional<CanErrorReport> SocketcanBus::take_error() {
  auto& errors = implementation_->errors;
  if (errors.empty()) return std::nullopt;
  const CanErrorReport report = errors.front();
  errors.pop_front();
  return report;
}

void SocketcanBus::async_wait_readable(WaitHandler handler) {
  implementation_->async_wait(boost::asio::posix::stream_descriptor::wait_read, std::move(handler));
}

void SocketcanBus::async_wait_writable(WaitHandler handler) {
  implementation_->async_wait(boost::asio::posix::stream_descriptor::wait_write, std::move(handler));
}

}  // namespace interpolated_motion::transport
