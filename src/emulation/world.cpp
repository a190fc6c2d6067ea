#include "interpolated_motion_driver/emulation/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace interpolated_motion::emulation {

World::World(HostTime start) : now_(start) {}

void World::require_free_name(const std::string& name) const {
  const auto has_name = [&](const auto& one) { return one->name() == name; };
  const bool taken = std::any_of(buses_.begin(), buses_.end(), has_name) ||
                     std::any_of(lines_.begin(), lines_.end(), has_name);
  if (taken) throw std::invalid_argument(fmt::format("bus {}: the name is taken", name));
}

transport::VirtualCanBus& World::add_can_bus(std::string name, int bitrate) {
  require_free_name(name);
  buses_.push_back(std::make_unique<transport::VirtualCanBus>(std::move(name), bitrate, now_));
  return *buses_.back();
}

void World::require_free_node(const transport::VirtualCanBus& bus, int node_id) const {
  for (const CanMember& member : can_members_) {
    if (member.bus != &bus || member.node_id != node_id) continue;
    throw std::invalid_argument(
        fmt::format("bus {}: node_id {} is taken by another drive", bus.name(), node_id));
  }
}

transport::CanBus& World::can_bus(std::string_view name) {
  for (const auto& bus : buses_) {
    if (bus->name() == name) return bus->host();
  }
  throw std::invalid_argument(fmt::format("bus {}: there is no emulated bus of that name", name));
}

transport::VirtualSerialLine& World::add_serial_line(std::string name,
                                                     const transport::SerialLineParameters& parameters) {
  require_free_name(name);
  lines_.push_back(std::make_unique<transport::VirtualSerialLine>(std::move(name), parameters, now_));
  return *lines_.back();
}

transport::SerialLine& World::serial_line(std::string_view name) {
  for (const auto& line : lines_) {
    if (line->name() == name) return line->host();
  }
  throw std::invalid_argument(fmt::format("line {}: there is no emulated line of that name", name));
}

HostTime World::next_event() const {
  HostTime next = kNever;
  for (const auto& bus : buses_) next = std::min(next, bus->next_event());
  for (const CanMember& member : can_members_) next = std::min(next, member.drive->next_event());
  for (const auto& line : lines_) next = std::min(next, line->next_event());
  for (const auto& drive : line_members_) next = std::min(next, drive->next_event());
  return next;
}

std::uint64_t World::delivered() const {
  std::uint64_t events = 0;
  for (const auto& bus : buses_) events += bus->delivered_to_host();
  for (const auto& line : lines_) events += line->host_wakeups();
  return events;
}

void World::process_events() {
  for (const CanMember& member : can_members_) {
    if (member.drive->next_event() <= now_) member.drive->process(now_);
  }
  for (const auto& bus : buses_) {
    if (bus->next_event() <= now_) bus->process(now_);
  }
  for (const auto& drive : line_members_) {
    if (drive->next_event() <= now_) drive->process(now_);
  }
  for (const auto& line : lines_) {
    if (line->next_event() <= now_) line->process(now_);
  }
}

HostTime World::advance(HostTime limit) {
  const std::uint64_t before = delivered();
  while (delivered() == before) {
    const HostTime next = next_event();
    if (next > limit) {
      now_ = std::max(now_, limit);
      for (const auto& bus : buses_) bus->process(now_);
      for (const auto& line : lines_) line->process(now_);
      break;
    }
    now_ = std::max(now_, next);
    process_events();
  }
  for (const auto& drive : line_members_) drive->process(now_);
  return now_;
}

}  // namespace interpolated_motion::emulation
