#include "interpolated_motion_driver/hardware/configuration_checks.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::hardware {

namespace {

/// Share of a bus that SDO, EMCY and controlwords need.
constexpr double kReserve = 0.1;
constexpr int kTimeStampBytes = 4;

void check_type(const DriveConfiguration& drive, const BusConfiguration& bus) {
  const BusType needed = drive.kind->bus_type();
  if (bus.type == needed) return;
  throw std::invalid_argument(fmt::format(
      "Parameter drives/{}/bus is \"{}\", whose type is {}; a drive of type {} needs a bus of type {}.",
      drive.joint, drive.bus, name_of(bus.type), drive.kind->name(), name_of(needed)));
}

/// Node ids and addresses: one owner each.
void check_nodes(const Configuration& configuration) {
  std::map<std::pair<std::string, int>, std::string> owners;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.type == BusType::Canopen) owners[{bus.name, bus.host_node_id}] = "the host (host_node_id)";
  }
  for (const DriveConfiguration& drive : configuration.drives) {
    check_type(drive, configuration.bus_of(drive));
    const auto [owner, free] = owners.insert({{drive.bus, drive.number}, "joint " + drive.joint});
    if (free) continue;
    const DriveNumbers& numbers = drive_numbers(drive.kind->bus_type());
    throw std::invalid_argument(fmt::format(
        "Parameter drives/{}/{} is {}, which {} has on bus {} already. Every drive of a "
        "bus needs {} of its own, 1..{}.",
        drive.joint, numbers.key, drive.number, owner->second, drive.bus, numbers.noun, numbers.highest));
  }
}

/// What flows whether anything moves or not: PDOs at each SYNC, heartbeats, time stamps.
double background_load(const BusConfiguration& bus, const std::vector<DriveConfiguration>& all_drives) {
  double per_sync = longest_frame_bits(0);
  int drives = 0;
  for (const DriveConfiguration& drive : all_drives) {
    if (drive.bus != bus.name) continue;
    per_sync += drive.kind->bits_per_sync(drive, bus);
    ++drives;
  }
  const int period = bus.time_stamp_period();
  const double time_stamps =
      period == 0 ? 0.0 : longest_frame_bits(kTimeStampBytes) / (period * bus.sync_period);
  const double per_heartbeat = (drives + 1) * longest_frame_bits(1);
  return (per_sync / bus.sync_period + time_stamps + per_heartbeat / bus.heartbeat_period) / bus.bitrate;
}

/// Two buses on one interface or port would disturb each other.
void check_devices(const Configuration& configuration) {
  std::map<std::string, std::string> owners;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.transport == TransportKind::Emulated) continue;
    const bool is_can = bus.transport == TransportKind::Socketcan;
    const std::string& device = is_can ? bus.socketcan.interface : bus.port.device;
    const auto [owner, free] = owners.insert({device, bus.name});
    if (free) continue;
    throw std::invalid_argument(fmt::format(
        "Parameter buses/{}/{} is \"{}\", which bus {} has already. Every bus needs one of its own.",
        bus.name, is_can ? "interface" : "device", device, owner->second));
  }
}

bool has_records(const BusConfiguration& bus, const Configuration& configuration) {
  return std::any_of(configuration.drives.begin(), configuration.drives.end(),
                     [&bus](const DriveConfiguration& drive) {
                       return drive.bus == bus.name && drive.kind->sends_records();
                     });
}

}  // namespace

void check_parts(const Configuration& configuration) {
  check_nodes(configuration);
  check_devices(configuration);
  for (const DriveConfiguration& drive : configuration.drives) drive.kind->check(drive, configuration);
}

void check_background_load(const Configuration& configuration) {
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.type != BusType::Canopen) continue;
    const auto drives =
        std::count_if(configuration.drives.begin(), configuration.drives.end(),
                      [&bus](const DriveConfiguration& drive) { return drive.bus == bus.name; });
    const double load = background_load(bus, configuration.drives);
    const double reserve = has_records(bus, configuration) ? bus.max_load : kReserve;
    if (load + reserve <= 1.0) continue;
    throw std::invalid_argument(
        fmt::format("Bus {} cannot carry {} drives: what they and the host exchange every {} s (sync_period) "
                    "fills {:.0f} % of {} bit/s, and {:.0f} % are reserved for motion records (max_load) and "
                    "for bring-up. Raise sync_period or bitrate, lower max_load, or use more buses.",
                    bus.name, drives, bus.sync_period, 100.0 * load, bus.bitrate, 100.0 * reserve));
  }
}

}  // namespace interpolated_motion::hardware
