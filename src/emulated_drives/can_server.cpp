#include "can_server.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/fault_injection.h"
#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr int kHostPort = 0;
constexpr HostDuration kLongestWait = std::chrono::milliseconds(100);

transport::SocketcanParameters interface_parameters(const std::string& interface, std::uint32_t bitrate) {
  transport::SocketcanParameters parameters;
  parameters.interface = interface;
  parameters.bitrate = bitrate;
  return parameters;
}

std::chrono::steady_clock::time_point to_steady(HostTime time) {
  return std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(time.time_since_epoch()));
}

}  // namespace

CanServer::CanServer(boost::asio::io_context& io, const std::string& interface, const DriveList& list,
                     Announcement announce)
    : world_(transport::read_host_clock()),
      bus_(world_.add_can_bus(interface, static_cast<int>(list.bitrate))),
      interface_(io, interface_parameters(interface, list.bitrate), world_.now()),
      interface_name_(interface),
      announce_(std::move(announce)),
      timer_(io) {
  for (const NamedDrive& drive : list.drives) {
    emulation::EposDrive& added = world_.add_epos(bus_, drive.parameters);
    const std::string node = std::to_string(drive.parameters.node_id);
    drives_[drive.name] = drives_[node] = &added;
    nodes_ += (nodes_.empty() ? "" : ", ") + node;
  }
}

void CanServer::turn() {
  const HostTime now = transport::read_host_clock();
  follow_interface(now);
  take_frames();
  run_drives(now);
  send_frames(now);
  wait_until(std::min({world_.next_event(), interface_.next_deadline(), now + kLongestWait}));
}

void CanServer::follow_interface(HostTime now) {
  if (interface_.poll_interface(now)) {
    const bool up = interface_.state() == transport::SocketcanState::Up;
    if (up) bus_.set_instantaneous(interface_.interface()->bitrate.has_value());
    announce_(up ? ready_text() : interface_.status_text());
    for (const std::string& advice : interface_.advice()) announce_("advice: " + advice);
  }
  wait_for_frames();
}

std::string CanServer::ready_text() const {
  const auto& bitrate = interface_.interface()->bitrate;
  const std::string timing = bitrate ? fmt::format("at {} bit/s", *bitrate)
                                     : fmt::format("with the bit times of {} bit/s", bus_.bitrate());
  return fmt::format("ready: EPOS2 drives with node ids {} on {} {}", nodes_, interface_name_, timing);
}

void CanServer::wait_for_frames() {
  // While the drives' bus is full, frames wait in the socket.
  const bool open = interface_.state() == transport::SocketcanState::Up;
  if (waiting_ || !open || bus_.free_slots(kHostPort) == 0) return;
  waiting_ = true;
  interface_.async_wait_readable([this](const boost::system::error_code&) {
    waiting_ = false;
    turn();
  });
}

void CanServer::take_frames() {
  while (bus_.free_slots(kHostPort) > 0) {
    const auto received = interface_.receive();
    if (!received) return;
    if (!received->own) bus_.host().send(received->frame, received->time);
  }
}

void CanServer::run_drives(HostTime now) {
  do {
    world_.advance(now);
    while (const auto frame = bus_.host().receive()) {
      if (!frame->own) outgoing_.push_back(frame->frame);
    }
  } while (world_.now() < now);
}

void CanServer::send_frames(HostTime now) {
  if (interface_.state() != transport::SocketcanState::Up) outgoing_.clear();
  while (!outgoing_.empty() && interface_.send(outgoing_.front(), now)) outgoing_.pop_front();
}

void CanServer::wait_until(HostTime time) {
  timer_.expires_at(to_steady(time));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) turn();
  });
}

bool CanServer::inject(const std::string& target, const std::string& command, std::string* reason) {
  const HostTime now = world_.now();
  if (target == interface_name_) return hardware::inject_bus_fault(bus_, command, now, reason);
  const auto drive = drives_.find(target);
  if (drive != drives_.end()) return hardware::inject_drive_fault(*drive->second, command, now, reason);
  *reason = fmt::format("\"{}\" is neither a drive nor the interface; there are nodes {} and {}", target,
                        nodes_, interface_name_);
  return false;
}

}  // namespace interpolated_motion::emulated_drives
