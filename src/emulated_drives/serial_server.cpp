#include "serial_server.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "interpolated_motion_driver/emulation/bus_faults.h"
#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr HostDuration kLongestWait = std::chrono::milliseconds(100);

}  // namespace

SerialServer::SerialServer(boost::asio::io_context& io, const ServedBus& served,
                           const std::string& samples_folder, Announcement announce)
    : Server(io, served, samples_folder, std::move(announce)),
      io_(io),
      line_(*std::get<transport::VirtualSerialLine*>(bus_)) {
  plug_in();
}

std::vector<emulation::FaultCommand> SerialServer::bus_faults() {
  auto faults = emulation::faults_of(line_, world_.now());
  faults.push_back({"unplug", {emulation::kFaultSeconds}, [this](const std::vector<double>& n) {
                      unplug(host_duration(n[0]));
                    }});
  return faults;
}

void SerialServer::unplug(HostDuration length) {
  terminal_.reset();
  incoming_.clear();
  plug_in_at_ = transport::read_host_clock() + length;
}

void SerialServer::plug_in() {
  plug_in_at_ = kNever;
  terminal_ = std::make_unique<transport::PseudoTerminal>(io_, name());
  announce(fmt::format("ready: {} on {} at {} bit/s", drives_text(), name(), line_.parameters().baud));
}

void SerialServer::turn() {
  const HostTime now = transport::read_host_clock();
  if (now >= plug_in_at_) plug_in();
  take_characters();
  wait_for_characters();
  run_drives(now);
  // A drive says nothing unless it was asked, so only the ends of texts on the line need a turn.
  turn_at(std::min({line_.next_text_end(), plug_in_at_, now + kLongestWait}));
}

void SerialServer::wait_for_characters() {
  if (waiting_ || !terminal_) return;
  waiting_ = true;
  terminal_->async_wait_readable([this](const boost::system::error_code&) {
    waiting_ = false;
    turn();
  });
}

void SerialServer::take_characters() {
  HostTime time{};
  while (terminal_ && !waiting_) {
    const auto character = terminal_->receive();
    if (!character) break;
    incoming_ += character->value;
    time = character->time;
  }
  if (!incoming_.empty() && line_.host().send(incoming_, time)) incoming_.clear();
}

void SerialServer::run_drives(HostTime now) {
  const std::uint64_t before = line_.host_wakeups();
  do {
    world_.advance(now);
  } while (world_.now() < now);
  if (line_.host_wakeups() == before) return;
  std::string outgoing;
  while (const auto character = line_.host().receive()) outgoing += character->value;
  if (terminal_) terminal_->send(outgoing, now);
}

}  // namespace interpolated_motion::emulated_drives
