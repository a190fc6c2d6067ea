#include "server.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/drive_kind.h"
#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {
namespace {

using hardware::DriveConfiguration;
using hardware::DriveKind;

std::string numbers_of(const std::vector<DriveConfiguration>& drives, const DriveKind* kind) {
  std::string numbers;
  for (const DriveConfiguration& drive : drives) {
    if (drive.kind == kind) numbers += (numbers.empty() ? "" : ", ") + std::to_string(drive.number);
  }
  return numbers;
}

/// Kind by kind, in the order in which their first drives come.
std::string text_of(const std::vector<DriveConfiguration>& drives) {
  std::string text;
  std::vector<const DriveKind*> told;
  for (const DriveConfiguration& drive : drives) {
    if (std::find(told.begin(), told.end(), drive.kind) != told.end()) continue;
    told.push_back(drive.kind);
    text +=
        fmt::format("{}{} drives with {} {}", text.empty() ? "" : " and ", drive.kind->product(),
                    hardware::drive_numbers(drive.kind->bus_type()).nouns, numbers_of(drives, drive.kind));
  }
  return text.empty() ? "no drives" : text;
}

}  // namespace

Server::Server(boost::asio::io_context& io, const ServedBus& served, const std::string& samples_folder,
               Announcement announce)
    : world_(transport::read_host_clock()),
      bus_(hardware::add_emulated_bus(world_, served.bus)),
      name_(served.bus.name),
      drives_text_(text_of(served.drives)),
      timer_(io),
      announce_(std::move(announce)) {
  for (const DriveConfiguration& drive : served.drives) add_drive(drive, samples_folder);
}

void Server::add_drive(const DriveConfiguration& drive, const std::string& samples_folder) {
  emulation::Drive& added = drive.kind->make_emulated(drive, world_, bus_);
  for (const std::string& name : {drive.joint, std::to_string(drive.number)}) drives_[name] = &added;
  if (samples_folder.empty()) return;
  SampleFile& file = samples_.emplace_back(samples_folder, drive.joint);
  added.observe([&file](const emulation::DemandSample& sample) { file.add(sample); });
}

std::optional<std::string> Server::inject(const std::string& target, const std::string& command) {
  const auto drive = drives_.find(target);
  return drive == drives_.end() ? emulation::obey_fault(command, bus_faults())
                                : drive->second->inject(command, world_.now());
}

std::string Server::target_names() const {
  std::string names = name_;
  for (const auto& [name, drive] : drives_) names += ", " + name;
  return names;
}

void Server::turn_at(HostTime time) {
  timer_.expires_at(std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(time.time_since_epoch())));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) turn();
  });
}

}  // namespace interpolated_motion::emulated_drives
