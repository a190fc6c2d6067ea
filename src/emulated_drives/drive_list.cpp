#include "drive_list.h"

#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/emulation_configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::emulated_drives {
namespace {

using hardware::ParameterReader;

/// What the emulation needs of a drive's configuration; the rest of it is for the driver.
hardware::DriveConfiguration read_drive(ParameterReader& reader) {
  hardware::DriveConfiguration drive;
  drive.node_id = static_cast<int>(reader.required_integer("node_id", 1, 127));
  drive.transmission.counts_per_revolution = reader.required_number("counts_per_revolution", 1.0, 1e8);
  drive.transmission.ratio = reader.number("gear_ratio", 1.0, 1e-6, 1e6);
  drive.transmission.direction = static_cast<int>(reader.integer("direction", 1, -1, 1));
  drive.transmission.offset = reader.number("offset", 0.0, -1e6, 1e6);
  return drive;
}

std::string choose_bus(const Options& options, ParameterReader& drives) {
  std::set<std::string> buses;
  for (const std::string& joint : drives.keys()) buses.insert(drives.map(joint).required_text("bus"));
  if (options.bus.empty() && buses.size() == 1) return *buses.begin();
  if (buses.count(options.bus) > 0) return options.bus;
  std::string names;
  for (const std::string& bus : buses) names += (names.empty() ? "" : ", ") + bus;
  throw std::invalid_argument(fmt::format("{}: choose a bus with --bus; drives are on: {}",
                                          options.config_file, names.empty() ? "none" : names));
}

DriveList read_configuration(const Options& options) {
  ParameterReader root(YAML::LoadFile(options.config_file), options.config_file + ": ");
  ParameterReader drives = root.map("drives");
  const std::string bus = choose_bus(options, drives);
  DriveList list;
  list.bitrate = static_cast<std::uint32_t>(
      root.map("buses").map(bus).integer("bitrate", list.bitrate, 10'000, 1'000'000));
  for (const std::string& joint : drives.keys()) {
    ParameterReader reader = drives.map(joint);
    if (reader.required_text("bus") != bus) continue;
    const auto drive = read_drive(reader);
    const auto emulation = hardware::parse_emulation(reader.map("emulation"), drive);
    if (!emulation.missing) list.drives.push_back({joint, emulation.drive});
  }
  return list;
}

DriveList drives_as_delivered(const Options& options) {
  DriveList list;
  for (const int node : options.nodes) {
    emulation::EposParameters parameters;
    parameters.node_id = static_cast<std::uint8_t>(node);
    parameters.serial_number = static_cast<std::uint32_t>(node);
    list.drives.push_back({std::to_string(node), parameters});
  }
  return list;
}

void set_clock_errors(const std::vector<double>& errors, DriveList& list) {
  if (errors.empty()) return;
  if (errors.size() != 1 && errors.size() != list.drives.size()) {
    throw std::invalid_argument(
        fmt::format("--clock-error-ppm has {} values for {} drives; allowed: 1, or one for each drive",
                    errors.size(), list.drives.size()));
  }
  for (std::size_t i = 0; i < list.drives.size(); ++i) {
    list.drives[i].parameters.clock_error_ppm = errors[errors.size() == 1 ? 0 : i];
  }
}

}  // namespace

DriveList make_drive_list(const Options& options) {
  DriveList list = options.config_file.empty() ? drives_as_delivered(options) : read_configuration(options);
  if (options.bitrate != 0) list.bitrate = options.bitrate;
  set_clock_errors(options.clock_errors, list);
  return list;
}

}  // namespace interpolated_motion::emulated_drives
