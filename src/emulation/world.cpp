#include "interpolated_motion_driver/emulation/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace interpolated_motion::emulation {

World::World(HostTime start) : now_(start) {}

transport::VirtualCanBus& World::add_can_bus(std::string name, int bitrate) {
  for (const auto& bus : buses_) {
    if (bus->name() == name) throw std::invalid_argument(fmt::format("bus {}: the name is taken", name));
  }
  buses_.push_back(std::make_unique<transport::VirtualCanBus>(std::move(name), bitrate, now_));
  return *buses_.back();
}

EposDrive& World::add_epos(transport::VirtualCanBus& bus, const EposParameters& parameters) {
  for (const Member& member : members_) {
    if (member.bus == &bus && member.drive->parameters().node_id == parameters.node_id) {
      throw std::invalid_argument(
          fmt::format("bus {}: node_id {} is taken by another drive", bus.name(), parameters.node_id));
    }
  }
  validate(parameters);
  members_.push_back({&bus, std::make_unique<EposDrive>(bus, parameters, now_)});
  return *members_.back().drive;
}

transport::CanBus& World::can_bus(std::string_view name) {
  for (const auto& bus : buses_) {
    if (bus->name() == name) return bus->host();
  }
  throw std::invalid_argument(fmt::format("bus {}: there is no emulated bus of that name", name));
}

HostTime World::next_event() const {
  HostTime next = kNever;
  for (const auto& bus : buses_) next = std::min(next, bus->next_event());
  for (const Member& member : members_) next = std::min(next, member.drive->next_event());
  return next;
}

std::uint64_t World::delivered() const {
  std::uint64_t frames = 0;
  for (const auto& bus : buses_) frames += bus->delivered_to_host();
  return frames;
}

void World::process_events() {
  for (const Member& member : members_) {
    if (member.drive->next_event() <= now_) member.drive->process(now_);
  }
  for (const auto& bus : buses_) {
    if (bus->next_event() <= now_) bus->process(now_);
  }
}

HostTime World::advance(HostTime limit) {
  const std::uint64_t before = delivered();
  while (delivered() == before) {
    const HostTime next = next_event();
    if (next > limit) {
      now_ = std::max(now_, limit);
      for (const auto& bus : buses_) bus->process(now_);
      break;
    }
    now_ = std::max(now_, next);
    process_events();
  }
  return now_;
}

}  // namespace interpolated_motion::emulation
