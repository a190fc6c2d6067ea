#include "interpolated_motion_driver/hardware/configuration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/configuration_checks.h"
#include "interpolated_motion_driver/hardware/cyclic_configuration.h"
#include "interpolated_motion_driver/hardware/emulation_configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/hardware/silverlode_configuration.h"

namespace interpolated_motion::hardware {

namespace {

using Urdf = std::map<std::string, trajectory::JointLimits>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Without a limit of its own a joint may reach its velocity limit within this time.
constexpr double kDefaultAccelerationTime = 0.1;
constexpr double kTimeStampInterval = 0.010;  // s

const std::vector<std::pair<std::string, std::uint32_t>> kBitrates = {
    {"1000000", 1000000}, {"800000", 800000}, {"500000", 500000}, {"250000", 250000},
    {"125000", 125000},   {"50000", 50000},   {"20000", 20000}};

/// As long as the drive's own patience with the host, so that a drive whose cable is cut and the others brake
/// at the same time. A SYNC waits for the answer to the last one, a quarter of heartbeat_timeout at most: so
/// much a silent drive puts off the positions of the others.
void parse_feedback_timeout(ParameterReader& reader, BusConfiguration& bus) {
  const double least = 0.25 * bus.heartbeat_timeout + 2.0 * bus.sync_period;
  bus.feedback_timeout =
      reader.number("feedback_timeout", std::max(bus.heartbeat_timeout, least), least, 60.0);
}

void parse_can_bus(ParameterReader& reader, BusConfiguration& bus) {
  bus.bitrate = reader.choice("bitrate", bus.bitrate, kBitrates);
  bus.sync_period = reader.number("sync_period", bus.sync_period, 0.001, 0.1);
  bus.heartbeat_period = reader.number("heartbeat_period", bus.heartbeat_period, 0.01, 10.0);
  bus.heartbeat_timeout = reader.number("heartbeat_timeout", bus.heartbeat_timeout, 0.02, 60.0);
  if (bus.heartbeat_timeout < 1.5 * bus.heartbeat_period) {
    reader.fail("heartbeat_timeout",
                fmt::format("is {} s; it must be at least 1.5 times heartbeat_period ({} s)",
                            bus.heartbeat_timeout, bus.heartbeat_period));
  }
  parse_feedback_timeout(reader, bus);
  bus.host_node_id = static_cast<int>(reader.integer("host_node_id", bus.host_node_id, 1, 127));
  bus.max_load = reader.number("max_load", bus.max_load, 0.01, 0.95);
  bus.clock_discipline = reader.boolean("clock_discipline", bus.clock_discipline);
  bus.sdo_timeout = reader.number("sdo_timeout", bus.sdo_timeout, 0.01, 10.0);
}

/// Of a bus whose type is known: the transports it can have, and what belongs to them.
void parse_transport(ParameterReader& reader, BusConfiguration& bus) {
  const bool is_can = bus.type == BusType::Canopen;
  const std::pair<std::string, TransportKind> real =
      is_can ? std::pair("socketcan", TransportKind::Socketcan) : std::pair("serial", TransportKind::Serial);
  bus.transport = reader.choice("transport", bus.transport, {{"emulated", TransportKind::Emulated}, real});
  if (bus.transport == TransportKind::Socketcan) {
    bus.socketcan.interface = reader.text("interface", bus.name);
    bus.socketcan.receive_all = reader.boolean("receive_all", bus.socketcan.receive_all);
  }
  if (bus.transport == TransportKind::Serial) {
    bus.port.device = reader.required_text("device");
    bus.port.low_latency = reader.boolean("low_latency", bus.port.low_latency);
    bus.port.rs485 = reader.boolean("rs485", bus.port.rs485);
  }
}

/// A serial port has 8 data bits without parity.
void check_stop_bits(const ParameterReader& reader, const BusConfiguration& bus) {
  const int bits = bus.serial.line.bits_per_character;
  if (bus.transport != TransportKind::Serial || bits <= 11) return;
  reader.fail("bits_per_character", fmt::format("is {}; a serial port sends 10 (8N1) or 11 (8N2)", bits));
}

BusConfiguration parse_bus(const std::string& name, ParameterReader reader) {
  BusConfiguration bus;
  bus.name = name;
  bus.type =
      reader.choice("type", bus.type, {{"canopen", BusType::Canopen}, {"silverlode", BusType::Silverlode}});
  parse_transport(reader, bus);
  if (bus.type == BusType::Canopen) {
    parse_can_bus(reader, bus);
  } else {
    parse_serial_line(reader, bus);
    check_stop_bits(reader, bus);
  }
  reader.refuse_unknown();
  return bus;
}

/// A limit of the configuration may tighten that of the URDF, never widen it.
double tightened(ParameterReader& reader, const std::string& key, double urdf, bool upper) {
  const double value = reader.number(key, urdf, -kInfinity, kInfinity);
  const bool wider = upper ? value > urdf : value < urdf;
  if (wider)
    reader.fail(key, fmt::format("is {}; the URDF allows {} and may only be tightened", value, urdf));
  return value;
}

trajectory::JointLimits parse_limits(const std::string& joint, ParameterReader reader, const Urdf& urdf) {
  const auto found = urdf.find(joint);
  if (found == urdf.end()) {
    reader.fail(
        "",
        fmt::format(
            "belongs to joint \"{}\", which the URDF does not have. Correct the name, or add the joint to "
            "the robot description",
            joint));
  }
  trajectory::JointLimits limits = found->second;
  limits.min_position = tightened(reader, "min_position", limits.min_position, false);
  limits.max_position = tightened(reader, "max_position", limits.max_position, true);
  limits.max_velocity = tightened(reader, "max_velocity", limits.max_velocity, true);
  if (!(limits.max_velocity > 0.0) || !std::isfinite(limits.max_velocity)) {
    reader.fail("max_velocity",
                fmt::format("is {}; it must be a finite number above 0: give the joint a velocity limit in "
                            "the URDF or here",
                            limits.max_velocity));
  }
  if (limits.min_position > limits.max_position) {
    reader.fail("min_position",
                fmt::format("is {}, above max_position {}", limits.min_position, limits.max_position));
  }
  limits.max_acceleration =
      reader.number("max_acceleration", limits.max_velocity / kDefaultAccelerationTime, 1e-6, 1e9);
  reader.refuse_unknown();
  return limits;
}

encoding::Transmission parse_transmission(ParameterReader& reader) {
  encoding::Transmission transmission;
  transmission.counts_per_revolution = reader.required_number("counts_per_revolution", 1.0, 1e8);
  transmission.ratio = reader.number("gear_ratio", 1.0, 1e-6, 1e6);
  transmission.direction = static_cast<int>(reader.integer("direction", 1, -1, 1));
  if (transmission.direction == 0) reader.fail("direction", "is 0; allowed: 1, -1");
  transmission.offset = reader.number("offset", 0.0, -1e6, 1e6);
  return transmission;
}

/// Counts, of the drive's demand from the path.
double default_bound(DriveType type) {
  switch (type) {
    case DriveType::EposIpm:
      return 1.0;
    case DriveType::SilverlodeIms:
      return 2.0;
    case DriveType::Cyclic:
      break;
  }
  return 5.0;
}

/// Counts, the same in a stream of setpoints. Segments of SilverLode drives are long beside the time between
/// two setpoints; so how far off they are is a matter of the motion and not of the encoder.
double default_stream_bound(const DriveConfiguration& drive) {
  constexpr double kSilverlode = 0.02;  // rad
  const double bound = drive.type == DriveType::SilverlodeIms
                           ? kSilverlode * std::abs(drive.transmission.counts_per_radian())
                           : 8.0 * drive.deviation_bound;
  return std::max(bound, drive.deviation_bound);
}

DriveConfiguration parse_drive(const std::string& joint, ParameterReader reader, const Urdf& urdf) {
  DriveConfiguration drive;
  drive.joint = joint;
  drive.bus = reader.required_text("bus");
  drive.type = reader.choice("type", drive.type,
                             {{"epos_ipm", DriveType::EposIpm},
                              {"silverlode_ims", DriveType::SilverlodeIms},
                              {"cyclic", DriveType::Cyclic}});
  drive.transmission = parse_transmission(reader);
  drive.limits = parse_limits(joint, reader.map("limits"), urdf);
  drive.deviation_bound = reader.number("deviation_bound", default_bound(drive.type), 0.6, 1000.0);
  if (drive.type != DriveType::Cyclic) {
    drive.stream_deviation_bound =
        reader.number("stream_deviation_bound", default_stream_bound(drive), drive.deviation_bound, 1e6);
  }
  drive.max_following_error = reader.number("max_following_error", drive.max_following_error, 1e-6, 1e3);
  drive.limit_margin = reader.number("limit_margin", drive.limit_margin, 1.0, 10.0);
  if (drive.type != DriveType::SilverlodeIms) {
    drive.node_id = static_cast<int>(reader.required_integer("node_id", 1, 127));
  }
  switch (drive.type) {
    case DriveType::EposIpm:
      drive.emulation = parse_emulation(reader.map("emulation"), drive);
      break;
    case DriveType::SilverlodeIms:
      parse_silverlode_drive(reader, drive);
      break;
    case DriveType::Cyclic:
      parse_cyclic_drive(reader, drive);
      break;
  }
  reader.refuse_unknown();
  return drive;
}

ConstraintConfiguration parse_constraints(ParameterReader reader, const std::vector<std::string>& joints) {
  ConstraintConfiguration constraints;
  constraints.goal_time = reader.number("goal_time", constraints.goal_time, 0.0, 1e6);
  constraints.stopped_velocity_tolerance =
      reader.number("stopped_velocity_tolerance", constraints.stopped_velocity_tolerance, 0.0, 1e6);
  for (const std::string& joint : joints) {
    ParameterReader entry = reader.map(joint);
    ConstraintConfiguration::Joint& limits = constraints.joints[joint];
    limits.trajectory = entry.number("trajectory", 0.0, 0.0, 1e6);
    limits.goal = entry.number("goal", 0.0, 0.0, 1e6);
    entry.refuse_unknown();
  }
  reader.refuse_unknown();
  return constraints;
}

motion::StreamParameters parse_setpoints(ParameterReader reader) {
  motion::StreamParameters stream;
  const auto time = [&reader](const char* key, GoalTime& value, double low, double high) {
    value = GoalTime{reader.number(key, value.count(), low, high)};
  };
  time("delay", stream.delay, 0.0, 1.0);
  time("horizon", stream.horizon, 0.05, 1.0);
  time("write_period", stream.write_period, 0.005, 1.0);
  time("linger", stream.linger, 0.0, 60.0);
  time("ride_through", stream.ride_through, 0.0, 1.0);
  time("max_age", stream.max_age, 0.0, 10.0);
  time("max_ahead", stream.max_ahead, 0.0, 10.0);
  time("catch_up", stream.catch_up, 0.0, 10.0);
  reader.refuse_unknown();
  return stream;
}

}  // namespace

int BusConfiguration::time_stamp_period() const {
  if (!clock_discipline) return 0;
  // A SYNC period of a hair less than 10 ms is one of 10 ms.
  return std::max(1, static_cast<int>(std::ceil(kTimeStampInterval / sync_period - 1e-6)));
}

Configuration parse_configuration(const YAML::Node& parameters, const Urdf& urdf,
                                  const std::vector<std::string>& node_keys) {
  ParameterReader reader(parameters, "");
  Configuration configuration;
  configuration.joints = reader.names("joints");
  ParameterReader buses = reader.map("buses");
  for (const std::string& name : buses.keys())
    configuration.buses.push_back(parse_bus(name, buses.map(name)));
  ParameterReader drives = reader.map("drives");
  for (const std::string& joint : configuration.joints) {
    if (!drives.has(joint)) drives.fail(joint, "is missing: every joint of `joints` needs a drive");
    configuration.drives.push_back(parse_drive(joint, drives.map(joint), urdf));
  }
  drives.refuse_unknown();
  configuration.constraints = parse_constraints(reader.map("constraints"), configuration.joints);
  auto& c = configuration;
  c.setpoints = parse_setpoints(reader.map("setpoints"));
  c.stop_trajectory_duration =
      reader.number("stop_trajectory_duration", c.stop_trajectory_duration, 0.0, 60.0);
  c.allow_partial_joints_goal = reader.boolean("allow_partial_joints_goal", c.allow_partial_joints_goal);
  c.start_tolerance = reader.number("start_tolerance", c.start_tolerance, 0.0, 10.0);
  c.commit_horizon = reader.number("commit_horizon", c.commit_horizon, 0.1, 60.0);
  c.bring_up_timeout = reader.number("bring_up_timeout", c.bring_up_timeout, 0.5, 600.0);
  c.settle_timeout = reader.number("settle_timeout", c.settle_timeout, 0.0, 600.0);
  c.enable_on_start = reader.boolean("enable_on_start", c.enable_on_start);
  for (const std::string& key : node_keys) reader.ignore(key);
  reader.refuse_unknown();
  check_parts(configuration);
  mark_isochronous_buses(configuration);
  check_background_load(configuration);
  return configuration;
}

}  // namespace interpolated_motion::hardware
