#include "can_server.h"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "interpolated_motion_driver/emulation/bus_faults.h"
#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr int kHostPort = 0;
/// A drive answers a frame at its next sample, so there is something on the bus of the drives after that
/// time. As long as there is, the drives are looked after that often, else as often as they have something to
/// say by themselves (heartbeats, emergencies).
constexpr HostDuration kAnswered = std::chrono::milliseconds(2);
constexpr HostDuration kIdleWait = std::chrono::milliseconds(10);

transport::SocketcanParameters interface_parameters(const hardware::BusConfiguration& bus) {
  transport::SocketcanParameters parameters;
  parameters.interface = bus.name;
  parameters.bitrate = bus.bitrate;
  parameters.confirmed = false;
  return parameters;
}

}  // namespace

CanServer::CanServer(boost::asio::io_context& io, const ServedBus& served, const std::string& samples_folder,
                     Announcement announce)
    : Server(io, served, samples_folder, std::move(announce)),
      wire_(*std::get<transport::VirtualCanBus*>(bus_)),
      interface_(io, interface_parameters(served.bus), world_.now()) {}

std::vector<emulation::FaultCommand> CanServer::bus_faults() {
  return emulation::faults_of(wire_, world_.now());
}

void CanServer::turn() {
  const HostTime now = transport::read_host_clock();
  follow_interface(now);
  take_frames();
  run_drives(now);
  send_frames(now);
  const bool talking = now - last_frame_ < kAnswered || wire_.next_event() != kNever;
  turn_at(now + (talking ? kAnswered : kIdleWait));
}

void CanServer::follow_interface(HostTime now) {
  if (interface_.poll_interface(now)) {
    const bool up = interface_.state() == transport::SocketcanState::Up;
    if (up) wire_.set_instantaneous(interface_.interface()->bitrate.has_value());
    announce(up ? ready_text() : interface_.status_text());
    for (const std::string& advice : interface_.advice()) announce("advice: " + advice);
  }
  wait_for_frames();
}

std::string CanServer::ready_text() const {
  const auto& bitrate = interface_.interface()->bitrate;
  const std::string timing = bitrate ? fmt::format("at {} bit/s", *bitrate)
                                     : fmt::format("with the bit times of {} bit/s", wire_.bitrate());
  return fmt::format("ready: {} on {} {}", drives_text(), name(), timing);
}

void CanServer::wait_for_frames() {
  // While the drives' bus is full, frames wait in the socket.
  const bool open = interface_.state() == transport::SocketcanState::Up;
  if (waiting_ || !open || wire_.free_slots(kHostPort) == 0) return;
  waiting_ = true;
  interface_.async_wait_readable([this](const boost::system::error_code&) {
    waiting_ = false;
    turn();
  });
}

void CanServer::take_frames() {
  while (wire_.free_slots(kHostPort) > 0) {
    const auto received = interface_.receive();
    if (!received) return;
    wire_.host().send(received->frame, received->time);
    last_frame_ = received->time;
  }
}

void CanServer::run_drives(HostTime now) {
  do {
    world_.advance(now);
    while (const auto frame = wire_.host().receive()) {
      if (frame->own) continue;
      outgoing_.push_back(frame->frame);
    }
  } while (world_.now() < now);
}

void CanServer::send_frames(HostTime now) {
  if (interface_.state() != transport::SocketcanState::Up) outgoing_.clear();
  while (!outgoing_.empty() && interface_.send(outgoing_.front(), now)) outgoing_.pop_front();
}

}  // namespace interpolated_motion::emulated_drives
