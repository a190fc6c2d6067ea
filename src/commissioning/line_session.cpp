#include "interpolated_motion_driver/commissioning/line_session.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::commissioning {
namespace {

/// A line that had no room is offered the request again after this time.
constexpr HostDuration kRetry = std::chrono::milliseconds(5);

}  // namespace

LineSession::LineSession(transport::SerialLine& line, Waiter& waiter, std::string name,
                         const silverlode::LineParameters& parameters)
    : line_(line), waiter_(waiter), master_(std::move(name), parameters) {}

silverlode::DeviceLink& LineSession::device(std::uint8_t address) {
  silverlode::DeviceLink* found = master_.find_device(address);
  return found != nullptr ? *found : master_.add_device(address);
}

void LineSession::listen(HostDuration duration) {
  const HostTime end = waiter_.now() + duration;
  while (waiter_.now() < end) turn(end);
}

silverlode::Outcome LineSession::ask(const silverlode::Request& request) {
  silverlode::DeviceLink& link = device(request.address);
  link.request(request);
  while (true) {
    if (const auto outcome = link.take_outcome()) return *outcome;
    turn(kNever);
  }
}

void LineSession::turn(HostTime limit) {
  HostTime now = waiter_.now();
  bool waits_for_room = false;
  while (const auto text = master_.peek_outgoing(now)) {
    waits_for_room = !line_.send(*text, now);
    if (waits_for_room) break;
    master_.pop_outgoing(now);
  }
  const HostTime retry = waits_for_room ? now + kRetry : kNever;
  waiter_.wait(std::min({limit, master_.next_deadline(), retry}));
  now = waiter_.now();
  while (const auto character = line_.receive()) {
    ++characters_;
    master_.on_character(character->value, character->time);
  }
  master_.poll(now);
}

}  // namespace interpolated_motion::commissioning
