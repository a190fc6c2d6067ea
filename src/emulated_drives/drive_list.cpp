#include "drive_list.h"

#include <limits>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/command_line/input_file.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::emulated_drives {
namespace {

using hardware::BusConfiguration;
using hardware::BusType;
using hardware::Configuration;
using hardware::TransportKind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The limits of a joint mean nothing to its drive: without the URDF, they are as wide as can be.
std::map<std::string, trajectory::JointLimits> any_limits(const YAML::Node& drives) {
  std::map<std::string, trajectory::JointLimits> limits;
  for (const auto& drive : drives) {
    trajectory::JointLimits& joint = limits[drive.first.Scalar()];
    joint.min_position = -kInfinity;
    joint.max_position = kInfinity;
    joint.max_velocity = std::numeric_limits<double>::max();
  }
  return limits;
}

Configuration load_configuration(const std::string& file) {
  const YAML::Node root = command_line::read_yaml_file(file);
  try {
    // Keys of the node are not checked here.
    const std::vector<std::string> keys = hardware::ParameterReader(root, "").keys();
    return hardware::parse_configuration(root, any_limits(root["drives"]), keys);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", file, error.what()));
  }
}

CanDrives can_drives(const Configuration& configuration, const BusConfiguration& bus, std::string interface) {
  CanDrives list;
  list.interface = std::move(interface);
  list.bitrate = bus.bitrate;
  for (const auto& drive : configuration.drives) {
    if (drive.bus == bus.name && !drive.emulation.missing)
      list.drives.push_back({drive.joint, drive.emulation.drive});
  }
  return list;
}

SerialDrives serial_drives(const Configuration& configuration, const BusConfiguration& bus,
                           std::string link) {
  SerialDrives list;
  list.link = std::move(link);
  list.line.baud = static_cast<int>(bus.serial.line.baud);
  list.line.bits_per_character = bus.serial.line.bits_per_character;
  list.line.wiring = bus.serial.wiring;
  for (const auto& drive : configuration.drives) {
    if (drive.bus == bus.name && !drive.emulation.missing)
      list.drives.push_back({drive.joint, drive.silverlode.emulated});
  }
  return list;
}

const BusConfiguration& choose_bus(const Configuration& configuration, const Options& options, BusType type) {
  std::string names;
  std::size_t found = 0;
  const BusConfiguration* chosen = nullptr;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.type != type) continue;
    names += (names.empty() ? "" : ", ") + bus.name;
    if (!options.bus.empty() && bus.name != options.bus) continue;
    chosen = &bus;
    ++found;
  }
  if (found == 1) return *chosen;
  throw std::invalid_argument(
      fmt::format("{}: choose a bus with --bus; of type {} there are: {}", options.config_file,
                  type == BusType::Canopen ? "canopen" : "silverlode", names.empty() ? "none" : names));
}

/// All buses that lead out of the driver's process.
DriveList drives_of_real_buses(const Configuration& configuration, const std::string& file) {
  DriveList list;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.transport == TransportKind::Socketcan)
      list.can.push_back(can_drives(configuration, bus, bus.socketcan.interface));
    if (bus.transport == TransportKind::Serial)
      list.serial.push_back(serial_drives(configuration, bus, bus.port.device));
  }
  if (!list.can.empty() || !list.serial.empty()) return list;
  throw std::invalid_argument(
      fmt::format("{}: no bus has the transport socketcan or serial; say where to serve by --can INTERFACE "
                  "or --serial LINK",
                  file));
}

DriveList drives_of_file(const Options& options) {
  const Configuration configuration = load_configuration(options.config_file);
  if (options.interface.empty() && options.link.empty())
    return drives_of_real_buses(configuration, options.config_file);
  DriveList list;
  if (!options.interface.empty()) {
    const auto& bus = choose_bus(configuration, options, BusType::Canopen);
    list.can.push_back(can_drives(configuration, bus, options.interface));
  }
  if (!options.link.empty()) {
    const auto& bus = choose_bus(configuration, options, BusType::Silverlode);
    list.serial.push_back(serial_drives(configuration, bus, options.link));
  }
  return list;
}

DriveList drives_as_delivered(const Options& options) {
  DriveList list;
  if (!options.interface.empty()) list.can.push_back({options.interface, 1'000'000, {}});
  for (const int node : options.nodes) {
    emulation::EposParameters parameters;
    parameters.node_id = static_cast<std::uint8_t>(node);
    parameters.serial_number = static_cast<std::uint32_t>(node);
    list.can.front().drives.push_back({std::to_string(node), parameters});
  }
  if (!options.link.empty()) list.serial.push_back({options.link, {}, {}});
  for (const int address : options.addresses) {
    emulation::SilverDustParameters parameters;
    parameters.address = address;
    list.serial.front().drives.push_back({std::to_string(address), parameters});
  }
  return list;
}

void set_clock_errors(const std::vector<double>& errors, DriveList& list) {
  std::vector<double*> clocks;
  for (CanDrives& bus : list.can)
    for (auto& drive : bus.drives) clocks.push_back(&drive.parameters.clock_error_ppm);
  for (SerialDrives& line : list.serial)
    for (auto& drive : line.drives) clocks.push_back(&drive.parameters.clock_error_ppm);
  if (errors.empty()) return;
  if (errors.size() != 1 && errors.size() != clocks.size()) {
    throw std::invalid_argument(
        fmt::format("--clock-error-ppm has {} values for {} drives; allowed: 1, or one for each drive",
                    errors.size(), clocks.size()));
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) *clocks[i] = errors[errors.size() == 1 ? 0 : i];
}

}  // namespace

DriveList make_drive_list(const Options& options) {
  DriveList list = options.config_file.empty() ? drives_as_delivered(options) : drives_of_file(options);
  for (CanDrives& bus : list.can)
    if (options.bitrate != 0) bus.bitrate = options.bitrate;
  for (SerialDrives& line : list.serial)
    if (options.baud != 0) line.line.baud = options.baud;
  set_clock_errors(options.clock_errors, list);
  return list;
}

}  // namespace interpolated_motion::emulated_drives
