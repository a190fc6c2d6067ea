#include "interpolated_motion_driver/hardware/bus_configuration.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace interpolated_motion::hardware {

namespace {

constexpr double kTimeStampInterval = 0.010;  // s
/// Shares of sync_period: drives shift their grid by a part of how late a SYNC is, and go on without one.
constexpr double kSyncTolerance = 0.05;
constexpr double kLeastSyncTolerance = 0.01;

/// The rates of command BRT.
const std::vector<std::pair<std::string, std::uint32_t>> kBauds = {
    {"300", 300},       {"1200", 1200},     {"2400", 2400},    {"4800", 4800},   {"9600", 9600},
    {"19200", 19200},   {"28800", 28800},   {"38400", 38400},  {"57600", 57600}, {"100000", 100000},
    {"115200", 115200}, {"230400", 230400}, {"250000", 250000}};

/// CiA 301, table 1.
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
  bus.sync_tolerance = reader.number("sync_tolerance", bus.sync_period * kSyncTolerance,
                                     bus.sync_period * kLeastSyncTolerance, bus.sync_period / 2.0);
  bus.heartbeat_period = reader.number("heartbeat_period", bus.heartbeat_period, 0.01, 10.0);
  bus.heartbeat_timeout = reader.number("heartbeat_timeout", bus.heartbeat_timeout, 0.02, 60.0);
  if (bus.heartbeat_timeout < 1.5 * bus.heartbeat_period) {
    reader.fail("heartbeat_timeout",
                fmt::format("is {} s; it must be at least 1.5 times heartbeat_period ({} s)",
                            bus.heartbeat_timeout, bus.heartbeat_period));
  }
  bus.watch_at_rest = reader.number("watch_at_rest", bus.watch_at_rest, 0.0, 60.0);
  if (bus.watch_at_rest > 0.0 && bus.watch_at_rest < 1.5 * bus.heartbeat_period) {
    reader.fail("watch_at_rest",
                fmt::format("is {} s; it must be 0 (never) or at least 1.5 times heartbeat_period ({} s)",
                            bus.watch_at_rest, bus.heartbeat_period));
  }
  parse_feedback_timeout(reader, bus);
  bus.host_node_id = static_cast<int>(reader.integer("host_node_id", bus.host_node_id, 1, 127));
  bus.max_load = reader.number("max_load", bus.max_load, 0.01, 0.95);
  bus.clock_discipline = reader.boolean("clock_discipline", bus.clock_discipline);
  bus.sdo_timeout = reader.number("sdo_timeout", bus.sdo_timeout, 0.01, 10.0);
  bus.listen_before_start = reader.number("listen_before_start", bus.listen_before_start, 0.0, 10.0);
  bus.refuse_other_masters =
      reader.choice("other_masters", bus.refuse_other_masters, {{"refuse", true}, {"allow", false}});
}

void parse_serial_line(ParameterReader& reader, BusConfiguration& bus) {
  silverlode::LineParameters& line = bus.serial.line;
  line.baud = reader.choice("baud", line.baud, kBauds);
  line.bits_per_character =
      static_cast<int>(reader.integer("bits_per_character", line.bits_per_character, 10, 12));
  line.turnaround = host_duration(reader.number("turnaround", seconds(line.turnaround), 0.0, 1.0));
  line.reply_timeout =
      host_duration(reader.number("reply_timeout", seconds(line.reply_timeout), 0.001, 10.0));
  if (line.reply_timeout < line.turnaround) {
    reader.fail("reply_timeout", fmt::format("is {} s; it must not be less than turnaround ({} s)",
                                             seconds(line.reply_timeout), seconds(line.turnaround)));
  }
  line.guard = host_duration(reader.number("guard", seconds(line.guard), 0.0, 10.0));
  line.repeats = static_cast<int>(reader.integer("repeats", line.repeats, 0, 100));
  bus.serial.wiring = reader.choice(
      "wiring", bus.serial.wiring,
      {{"rs485", transport::SerialWiring::Rs485TwoWire}, {"rs232", transport::SerialWiring::Rs232MultiDrop}});
  bus.serial.start =
      reader.choice("start", bus.serial.start,
                    {{"addressed", LineStartKind::Addressed}, {"global", LineStartKind::Global}});
  bus.serial.start_lead = reader.number("start_lead", bus.serial.start_lead, 0.05, 10.0);
  bus.serial.status_period = reader.number("status_period", bus.serial.status_period, 0.005, 0.25);
  bus.max_load = reader.number("max_load", 0.85, 0.01, 0.95);
}

/// Of a bus whose type is known: the transports it can have, and what belongs to them.
void parse_transport(ParameterReader& reader, BusConfiguration& bus) {
  const bool is_can = bus.type == BusType::Canopen;
  const std::pair<std::string, TransportKind> real =
      is_can ? std::pair("socketcan", TransportKind::Socketcan) : std::pair("serial", TransportKind::Serial);
  bus.transport = reader.choice("transport", bus.transport, {{"emulated", TransportKind::Emulated}, real});
  if (bus.transport == TransportKind::Socketcan) {
    bus.socketcan.interface = reader.has("interface") ? reader.required_name("interface") : bus.name;
    reader.ignore("interface");
    bus.socketcan.receive_all = reader.boolean("receive_all", bus.socketcan.receive_all);
  }
  if (bus.transport == TransportKind::Serial) {
    bus.port.device = reader.required_name("device");
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

std::vector<std::uint32_t> values_of(const std::vector<std::pair<std::string, std::uint32_t>>& choices) {
  std::vector<std::uint32_t> values;
  values.reserve(choices.size());
  for (const auto& [name, value] : choices) values.push_back(value);
  return values;
}

}  // namespace

std::vector<std::uint32_t> serial_rates() { return values_of(kBauds); }

std::vector<std::uint32_t> can_rates() { return values_of(kBitrates); }

const DriveNumbers& drive_numbers(BusType type) {
  static const DriveNumbers nodes{"node_id", "a node id", "node ids", 127};
  static const DriveNumbers addresses{"address", "an address", "addresses", 254};
  return type == BusType::Canopen ? nodes : addresses;
}

const char* name_of(BusType type) { return type == BusType::Canopen ? "canopen" : "silverlode"; }

int BusConfiguration::time_stamp_period() const {
  if (!clock_discipline) return 0;
  // A SYNC period of a hair less than 10 ms is one of 10 ms.
  return std::max(1, static_cast<int>(std::ceil(kTimeStampInterval / sync_period - 1e-6)));
}

BusConfiguration parse_bus(const std::string& name, ParameterReader reader) {
  BusConfiguration bus;
  bus.name = name;
  bus.type = reader.choice(
      "type", bus.type,
      {{name_of(BusType::Canopen), BusType::Canopen}, {name_of(BusType::Silverlode), BusType::Silverlode}});
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

}  // namespace interpolated_motion::hardware
