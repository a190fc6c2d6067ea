#include "interpolated_motion_driver/hardware/configuration_checks.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/cyclic_configuration.h"

namespace interpolated_motion::hardware {

namespace {

/// Worst case of an 8-byte frame with an 11-bit identifier (Davis et al., "CAN schedulability analysis").
constexpr double kLongestFrameBits = 135.0;
constexpr double kSyncBits = 55.0;
constexpr double kHeartbeatBits = 65.0;
constexpr double kTimeStampBits = 95.0;
/// Share of a bus that SDO, EMCY and controlwords need.
constexpr double kReserve = 0.1;

bool is_on_canopen(const DriveConfiguration& drive) { return drive.type != DriveType::SilverlodeIms; }

const char* name_of(DriveType type) {
  switch (type) {
    case DriveType::EposIpm:
      return "epos_ipm";
    case DriveType::SilverlodeIms:
      return "silverlode_ims";
    case DriveType::Cyclic:
      break;
  }
  return "cyclic";
}

const BusConfiguration& bus_of(const DriveConfiguration& drive, const Configuration& configuration) {
  const auto found = std::find_if(configuration.buses.begin(), configuration.buses.end(),
                                  [&drive](const BusConfiguration& bus) { return bus.name == drive.bus; });
  if (found == configuration.buses.end()) {
    throw std::invalid_argument(
        fmt::format("Parameter drives/{}/bus is \"{}\", which is not among buses. Add it there or "
                    "correct the name.",
                    drive.joint, drive.bus));
  }
  return *found;
}

void check_type(const DriveConfiguration& drive, const BusConfiguration& bus) {
  const bool is_can = bus.type == BusType::Canopen;
  if (is_can == is_on_canopen(drive)) return;
  throw std::invalid_argument(fmt::format(
      "Parameter drives/{}/bus is \"{}\", whose type is {}; a drive of type {} needs a bus of type {}.",
      drive.joint, drive.bus, is_can ? "canopen" : "silverlode", name_of(drive.type),
      is_can ? "silverlode" : "canopen"));
}

/// Node ids and addresses: one owner each.
void check_nodes(const Configuration& configuration) {
  std::map<std::pair<std::string, int>, std::string> owners;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.type == BusType::Canopen) owners[{bus.name, bus.host_node_id}] = "the host (host_node_id)";
  }
  for (const DriveConfiguration& drive : configuration.drives) {
    check_type(drive, bus_of(drive, configuration));
    const bool is_can = is_on_canopen(drive);
    const int number = is_can ? drive.node_id : drive.silverlode.address;
    const auto [owner, free] = owners.insert({{drive.bus, number}, "joint " + drive.joint});
    if (!free) {
      throw std::invalid_argument(
          fmt::format("Parameter drives/{}/{} is {}, which {} has on bus {} already. Every drive of a "
                      "bus needs {} of its own, 1..{}.",
                      drive.joint, is_can ? "node_id" : "address", number, owner->second, drive.bus,
                      is_can ? "a node id" : "an address", is_can ? 127 : 254));
    }
  }
}

/// One command starts all drives of a line: it has one set of arguments.
void check_common_starts(const Configuration& configuration) {
  std::map<std::string, const DriveConfiguration*> first_of;
  for (const DriveConfiguration& drive : configuration.drives) {
    if (bus_of(drive, configuration).serial.start != LineStartKind::Global) continue;
    const DriveConfiguration& first = *first_of.insert({drive.bus, &drive}).first->second;
    if (drive.silverlode.ims_arguments == first.silverlode.ims_arguments) continue;
    throw std::invalid_argument(fmt::format(
        "Parameter drives/{}/ims_arguments is \"{}\", that of joint {} is \"{}\": with buses/{}/start: "
        "global "
        "one command starts both. Give all drives of the bus the same, or set start to addressed.",
        drive.joint, drive.silverlode.ims_arguments, first.joint, first.silverlode.ims_arguments, drive.bus));
  }
}

/// Bits that flow between host and drive at each SYNC: of an EPOS a position and a buffer report, and a tenth
/// of a demand report.
double bits_per_sync(const DriveConfiguration& drive, const BusConfiguration& bus) {
  return drive.type == DriveType::Cyclic ? cyclic_bits_per_sync(bus) : 2.1 * kLongestFrameBits;
}

/// What flows whether anything moves or not: PDOs at each SYNC, heartbeats, time stamps.
double background_load(const BusConfiguration& bus, const std::vector<DriveConfiguration>& all_drives) {
  double per_sync = kSyncBits;
  int drives = 0;
  for (const DriveConfiguration& drive : all_drives) {
    if (drive.bus != bus.name) continue;
    per_sync += bits_per_sync(drive, bus);
    ++drives;
  }
  const int period = bus.time_stamp_period();
  const double time_stamps = period == 0 ? 0.0 : kTimeStampBits / (period * bus.sync_period);
  const double per_heartbeat = (drives + 1) * kHeartbeatBits;
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
                       return drive.bus == bus.name && drive.type == DriveType::EposIpm;
                     });
}

}  // namespace

void check_parts(const Configuration& configuration) {
  check_nodes(configuration);
  check_common_starts(configuration);
  check_devices(configuration);
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
