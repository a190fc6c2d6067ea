#include "drive_list.h"

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

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
using hardware::DriveConfiguration;
using hardware::TransportKind;
using hardware::UrdfLimits;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The limits of a joint mean nothing to its drive: without the URDF, they are as wide as can be, and it is
// prismatic where the drive is said to move it by a length.
UrdfLimits any_limits(const YAML::Node& drives) {
  UrdfLimits limits;
  for (const auto& drive : drives) {
    trajectory::JointLimits& joint = limits[drive.first.Scalar()];
    if (drive.second.IsMap() && drive.second["travel_per_revolution"].IsDefined())
      joint.unit = trajectory::JointUnit::Metre;
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

/// The drives of a bus of the file, on the interface or link `place`.
ServedBus served(const Configuration& configuration, const BusConfiguration& bus, const std::string& place,
                 const std::string& file) {
  ServedBus served{bus, {}};
  served.bus.name = place;
  bool any = false;
  for (const DriveConfiguration& drive : configuration.drives) {
    if (drive.bus != bus.name) continue;
    any = true;
    if (!drive.emulation.missing) served.drives.push_back(drive);
  }
  if (any) return served;
  throw std::invalid_argument(
      fmt::format("{}: no drive is on bus {}, so there is nothing to serve on {}", file, bus.name, place));
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
  throw std::invalid_argument(fmt::format("{}: choose a bus with --bus; of type {} there are: {}",
                                          options.config_file, hardware::name_of(type),
                                          names.empty() ? "none" : names));
}

/// All buses that lead out of the driver's process.
std::vector<ServedBus> drives_of_real_buses(const Configuration& configuration, const std::string& file) {
  std::vector<ServedBus> list;
  for (const BusConfiguration& bus : configuration.buses) {
    if (bus.transport == TransportKind::Socketcan)
      list.push_back(served(configuration, bus, bus.socketcan.interface, file));
    if (bus.transport == TransportKind::Serial)
      list.push_back(served(configuration, bus, bus.port.device, file));
  }
  if (!list.empty()) return list;
  throw std::invalid_argument(
      fmt::format("{}: no bus has the transport socketcan or serial; say where to serve by --can INTERFACE "
                  "or --serial LINK",
                  file));
}

std::vector<ServedBus> drives_of_file(const Options& options) {
  const std::string& file = options.config_file;
  const Configuration configuration = load_configuration(file);
  if (options.interface.empty() && options.link.empty()) return drives_of_real_buses(configuration, file);
  std::vector<ServedBus> list;
  const auto add = [&](BusType type, const std::string& place) {
    if (!place.empty())
      list.push_back(served(configuration, choose_bus(configuration, options, type), place, file));
  };
  add(BusType::Canopen, options.interface);
  add(BusType::Silverlode, options.link);
  return list;
}

/// Drives on a bus of their own, each as it leaves the factory: what `settings` does not say has its default.
ServedBus drives_as_delivered(BusType type, const std::string& place, const std::vector<int>& numbers,
                              const std::string& settings) {
  ServedBus served;
  served.bus.name = place;
  served.bus.type = type;
  for (const int number : numbers) {
    const std::string name = std::to_string(number);
    YAML::Node drive = YAML::Load(settings);
    drive["bus"] = place;
    drive[hardware::drive_numbers(type).key] = number;
    YAML::Node drives;
    drives[name] = drive;
    served.drives.push_back(hardware::parse_drive(name, hardware::ParameterReader(drive, "drives/" + name),
                                                  any_limits(drives), hardware::drive_kinds()));
  }
  return served;
}

std::vector<ServedBus> drives_as_delivered(const Options& options) {
  std::vector<ServedBus> list;
  if (!options.interface.empty()) {
    list.push_back(drives_as_delivered(BusType::Canopen, options.interface, options.nodes,
                                       "{type: epos_ipm, counts_per_revolution: 2000}"));
  }
  if (!options.link.empty()) {
    list.push_back(drives_as_delivered(BusType::Silverlode, options.link, options.addresses,
                                       "{type: silverlode_ims, counts_per_revolution: 4000}"));
  }
  return list;
}

void set_clock_errors(const std::vector<double>& errors, std::vector<ServedBus>& list) {
  std::vector<double*> clocks;
  for (ServedBus& served : list)
    for (DriveConfiguration& drive : served.drives) clocks.push_back(&drive.emulation.clock_error_ppm);
  if (errors.empty()) return;
  if (errors.size() != 1 && errors.size() != clocks.size()) {
    throw std::invalid_argument(
        fmt::format("--clock-error-ppm has {} values for {} drives; allowed: 1, or one for each drive",
                    errors.size(), clocks.size()));
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) *clocks[i] = errors[errors.size() == 1 ? 0 : i];
}

}  // namespace

std::vector<ServedBus> make_drive_list(const Options& options) {
  auto list = options.config_file.empty() ? drives_as_delivered(options) : drives_of_file(options);
  for (ServedBus& served : list) {
    if (options.bitrate != 0) served.bus.bitrate = static_cast<std::uint32_t>(options.bitrate);
    if (options.baud != 0) served.bus.serial.line.baud = static_cast<std::uint32_t>(options.baud);
  }
  set_clock_errors(options.clock_errors, list);
  return list;
}

}  // namespace interpolated_motion::emulated_drives
