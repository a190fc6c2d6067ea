#include "serial_server.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/fault_injection.h"
#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr HostDuration kLongestWait = std::chrono::milliseconds(100);
constexpr double kLongestUnplugged = 3600.0;  // s

}  // namespace

SerialServer::SerialServer(boost::asio::io_context& io, const SerialDrives& list,
                           const std::string& samples_folder, Announcement announce)
    : Server(io, std::move(announce)),
      io_(io),
      line_(world_.add_serial_line(list.link, list.line)),
      link_(list.link) {
  for (const auto& drive : list.drives) add_drive(drive, samples_folder);
  add_target(link_, [this](const std::string& command, std::string* reason) {
    return inject_line_fault(command, reason);
  });
  plug_in();
}

void SerialServer::add_drive(const NamedDrive<emulation::SilverDustParameters>& drive,
                             const std::string& samples_folder) {
  emulation::SilverDust& added = world_.add_silverdust(line_, drive.parameters);
  const std::string address = std::to_string(drive.parameters.address);
  addresses_ += (addresses_.empty() ? "" : ", ") + address;
  for (const std::string& name : {drive.name, address}) {
    add_target(name, [this, &added](const std::string& command, std::string* reason) {
      return hardware::inject_drive_fault(added, command, world_.now(), reason);
    });
  }
  if (samples_folder.empty()) return;
  SampleFile& file = samples_.emplace_back(samples_folder, drive.name);
  const double tick = seconds(drive.parameters.tick);
  added.set_sample_observer([&file, tick](const emulation::SilverDustSample& sample) {
    const double elapsed = tick * static_cast<double>(sample.ticks_since_start);
    file.add({sample.time, elapsed, sample.demand, sample.actual}, sample.interpolating);
  });
}

bool SerialServer::inject_line_fault(const std::string& command, std::string* reason) {
  const std::string unplug_command = "unplug ";
  if (command.compare(0, unplug_command.size(), unplug_command) == 0)
    return unplug(command.substr(unplug_command.size()), reason);
  if (hardware::inject_line_fault(line_, command, world_.now(), reason)) return true;
  *reason += ", unplug SECONDS";
  return false;
}

bool SerialServer::unplug(const std::string& duration, std::string* reason) {
  char* end = nullptr;
  const double length = std::strtod(duration.c_str(), &end);
  if (end == duration.c_str() || *end != '\0' || !(length >= 0.0 && length <= kLongestUnplugged)) {
    *reason = fmt::format("\"{}\" is not a number within 0..{}", duration, kLongestUnplugged);
    return false;
  }
  terminal_.reset();
  incoming_.clear();
  plug_in_at_ = transport::read_host_clock() + host_duration(length);
  return true;
}

void SerialServer::plug_in() {
  plug_in_at_ = kNever;
  terminal_ = std::make_unique<transport::PseudoTerminal>(io_, link_);
  announce(fmt::format("ready: SilverLode drives with addresses {} on {} at {} bit/s", addresses_, link_,
                       line_.parameters().baud));
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
