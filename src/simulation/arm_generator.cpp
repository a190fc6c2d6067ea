#include "simulation/arm_generator.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/recording/yaml_text.h"
#include "simulation/arm.h"

namespace interpolated_motion::simulation {

namespace {

constexpr int kAttempts = 50;

/// Sets `key` in one of two cases.
template <class Value>
void maybe(Random& random, YAML::Node map, const char* key, const Value& value) {
  if (random.chance(0.5)) map[key] = value;
}

YAML::Node random_can_bus(Random& random) {
  YAML::Node bus = YAML::Load("{type: canopen}");
  maybe(random, bus, "bitrate", random.pick({1000000, 500000}));
  maybe(random, bus, "sync_period", random.pick({0.005, 0.01, 0.02}));
  maybe(random, bus, "clock_discipline", random.chance(0.7));
  maybe(random, bus, "heartbeat_timeout", random.pick({0.3, 1.0}));
  return bus;
}

YAML::Node random_line(Random& random) {
  YAML::Node bus = YAML::Load("{type: silverlode}");
  maybe(random, bus, "baud", random.pick({57600, 115200, 230400}));
  maybe(random, bus, "wiring", random.pick<std::string>({"rs485", "rs232"}));
  maybe(random, bus, "start", random.pick<std::string>({"addressed", "global"}));
  maybe(random, bus, "status_period", random.pick({0.02, 0.1}));
  return bus;
}

void set_epos_unknowns(Random& random, const YAML::Node& emulation) {
  maybe(random, emulation, "clock_discipline", random.chance(0.5));
  maybe(random, emulation, "limits_scale_with_notation", random.chance(0.5));
  maybe(random, emulation, "limit_ranges_scale_with_notation", random.chance(0.5));
  maybe(random, emulation, "time_stamp_pdo_mappable", random.chance(0.5));
  maybe(random, emulation, "free_records_pdo_mappable", random.chance(0.5));
  maybe(random, emulation, "record_release",
        random.pick<std::string>({"at_segment_end", "at_segment_start"}));
  maybe(random, emulation, "underflow_test", random.pick<std::string>({"at_segment_end", "every_sample"}));
  maybe(random, emulation, "motion_check", random.pick<std::string>({"samples", "knots"}));
  maybe(random, emulation, "position_limit_check", random.pick<std::string>({"run_time", "per_record"}));
  maybe(random, emulation, "halt_release", random.pick<std::string>({"resume", "needs_new_start"}));
}

/// The driver's `position_lag` belongs to the drive's way of integrating, docs/silverlode.md.
void set_integration(Random& random, YAML::Node drive, YAML::Node emulation) {
  const int way = random.whole(0, 2);
  if (way == 0) return;
  emulation["integration"] = way == 1 ? "velocity_first" : "position_first";
  drive["position_lag"] = way == 1 ? 0 : 1;
}

void set_silverlode_unknowns(Random& random, const YAML::Node& drive, const YAML::Node& emulation) {
  maybe(random, emulation, "queue_depth", random.pick({4, 8}));
  maybe(random, emulation, "multi_register_read", random.chance(0.5));
  maybe(random, emulation, "ims_arguments", random.pick({-1, 2}));
  maybe(random, emulation, "turnaround", random.pick({0.0005, 0.002}));
  maybe(random, emulation, "acceleration_rounding", random.pick<std::string>({"truncated", "exact"}));
  maybe(random, emulation, "bad_values", random.pick<std::string>({"nak", "command_error"}));
  maybe(random, emulation, "disabled_start", random.pick<std::string>({"command_error", "busy"}));
  maybe(random, emulation, "tick_phase", random.thousandths(0.0, 0.119) / 1000.0);
  set_integration(random, drive, emulation);
}

void set_cyclic_unknowns(Random& random, const YAML::Node& drive, const YAML::Node& emulation) {
  maybe(random, drive, "interpolation_order", random.whole(1, 3));
  maybe(random, emulation, "sync_gain", random.pick({0.05, 0.5}));
  maybe(random, emulation, "ride_through", random.pick({2, 5}));
}

void set_emulation(Random& random, const std::string& type, YAML::Node drive) {
  YAML::Node emulation(YAML::NodeType::Map);
  maybe(random, emulation, "clock_error_ppm", random.whole(-100, 100));
  maybe(random, emulation, "initial_position", random.thousandths(-1.0, 1.0));
  if (type == "epos_ipm") set_epos_unknowns(random, emulation);
  if (type == "silverlode_ims") set_silverlode_unknowns(random, drive, emulation);
  if (type == "cyclic") set_cyclic_unknowns(random, drive, emulation);
  if (type != "silverlode_ims") {
    maybe(random, emulation, "tick_phase", random.thousandths(0.0, 0.9) / 1000.0);
    maybe(random, emulation, "lag_ms", random.pick({0.0, 5.0}));
  }
  if (emulation.size() > 0) drive["emulation"] = emulation;
}

YAML::Node random_drive(Random& random, const std::string& type, const std::string& bus, int number) {
  YAML::Node drive;
  drive["bus"] = bus;
  drive["type"] = type;
  drive[type == "silverlode_ims" ? "address" : "node_id"] = number;
  drive["counts_per_revolution"] = random.pick({2000, 4000, 8000});
  drive["gear_ratio"] = random.pick({50, 100});
  maybe(random, drive, "direction", random.pick({1, -1}));
  maybe(random, drive, "offset", random.thousandths(-0.5, 0.5));
  YAML::Node limits;
  limits["max_acceleration"] = random.pick({5, 10, 20});
  maybe(random, limits, "max_velocity", random.pick({1.0, 2.0, 3.5}));
  drive["limits"] = limits;
  set_emulation(random, type, drive);
  return drive;
}

std::vector<std::string> types_of(Random& random, const std::string& kind) {
  if (kind == "epos") return {"epos_ipm"};
  if (kind == "silverlode") return {"silverlode_ims"};
  if (kind == "cyclic") return {"cyclic"};
  if (kind == "mixed") return {"epos_ipm", "silverlode_ims"};
  if (kind == "all") return {"cyclic", "epos_ipm", "silverlode_ims"};
  std::vector<std::string> types;
  for (const char* type : {"epos_ipm", "silverlode_ims", "cyclic"})
    if (random.chance(0.5)) types.emplace_back(type);
  return types.empty() ? std::vector<std::string>{"epos_ipm"} : types;
}

int random_size(Random& random, const std::string& kind, std::size_t types) {
  if (kind == "random" && random.chance(0.2)) return random.whole(1, 12);
  return std::max(static_cast<int>(types), random.whole(1, 4));
}

/// Up to three SilverLode drives a line; CAN drives on one bus or two.
std::string bus_for(Random& random, YAML::Node buses, const std::string& type, int index, bool two_buses) {
  const bool is_serial = type == "silverlode_ims";
  const int which = is_serial ? index / 3 : two_buses ? index % 2 : 0;
  std::string name = fmt::format("{}{}", is_serial ? "line" : "can", which);
  if (!buses[name]) buses[name] = is_serial ? random_line(random) : random_can_bus(random);
  return name;
}

void set_group(Random& random, YAML::Node yaml) {
  maybe(random, yaml, "commit_horizon", random.pick({0.3, 0.5, 1.0, 4.0}));
  if (random.chance(0.2)) yaml["enable_on_start"] = false;
  if (random.chance(0.3)) yaml["allow_partial_joints_goal"] = true;
  if (random.chance(0.2)) yaml["setpoints"]["linger"] = 0.2;
  if (random.chance(0.2)) yaml["setpoints"]["delay"] = 0.1;
  if (random.chance(0.2)) yaml["join"] = "late";
}

YAML::Node draw(Random& random, const std::string& kind) {
  const auto types = types_of(random, kind);
  const int size = random_size(random, kind, types.size());
  const bool two_buses = random.chance(0.2);
  YAML::Node yaml;
  YAML::Node buses(YAML::NodeType::Map);
  int serial_drives = 0;
  for (int i = 0; i < size; ++i) {
    const std::string& type = types[static_cast<std::size_t>(i) % types.size()];
    const int index = type == "silverlode_ims" ? serial_drives++ : i;
    const std::string joint = fmt::format("joint{}", i + 1);
    const std::string bus = bus_for(random, buses, type, index, two_buses);
    yaml["joints"].push_back(joint);
    yaml["drives"][joint] = random_drive(random, type, bus, i + 1);
  }
  yaml["buses"] = buses;
  set_group(random, yaml);
  return yaml;
}

bool is_taken(const std::string& text) {
  try {
    hardware::parse_configuration(YAML::Load(text), robot_description());
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

const std::vector<std::string>& arm_kinds() {
  static const std::vector<std::string> kinds{"epos", "silverlode", "cyclic", "mixed", "all", "random"};
  return kinds;
}

std::string random_arm(Random& random, const std::string& kind) {
  for (int i = 0; i < kAttempts; ++i) {
    std::string text = recording::one_line(draw(random, kind));
    if (is_taken(text)) return text;
  }
  throw std::logic_error("no random arm of kind " + kind + " is taken by the driver");
}

}  // namespace interpolated_motion::simulation
