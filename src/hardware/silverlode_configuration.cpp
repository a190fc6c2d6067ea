#include "interpolated_motion_driver/hardware/silverlode_configuration.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/request.h"

namespace interpolated_motion::hardware {

namespace {

using namespace emulation;

/// The rates of command BRT.
const std::vector<std::pair<std::string, std::uint32_t>> kBauds = {
    {"300", 300},       {"1200", 1200},     {"2400", 2400},    {"4800", 4800},   {"9600", 9600},
    {"19200", 19200},   {"28800", 28800},   {"38400", 38400},  {"57600", 57600}, {"100000", 100000},
    {"115200", 115200}, {"230400", 230400}, {"250000", 250000}};

void parse_scales(ParameterReader& reader, DriveConfiguration& drive) {
  SilverlodeConfiguration& silverlode = drive.silverlode;
  auto& scale = silverlode.scale;
  scale.counts_per_revolution = drive.transmission.counts_per_revolution;
  scale.tick = reader.number("tick", scale.tick, 10e-6, 1e-3);
  scale.velocity_full_scale_rpm =
      reader.number("velocity_full_scale", scale.velocity_full_scale_rpm, 1.0, 1e5);
  scale.acceleration_full_scale_rpm_per_tick =
      reader.number("ims_acceleration_full_scale", scale.acceleration_full_scale_rpm_per_tick, 1.0, 1e5);
  scale.position_lag = reader.number("position_lag", scale.position_lag, 0.0, 1.0);
  auto& command = silverlode.command_scale;
  command.counts_per_revolution = scale.counts_per_revolution;
  command.tick = scale.tick;
  command.velocity_full_scale_rpm = scale.velocity_full_scale_rpm;
  command.ims_acceleration_full_scale_rpm_per_tick = scale.acceleration_full_scale_rpm_per_tick;
  command.acceleration_full_scale_rpm_per_tick =
      reader.number("acceleration_full_scale", command.acceleration_full_scale_rpm_per_tick, 1.0, 1e5);
}

void parse_emulated_physics(ParameterReader& reader, const DriveConfiguration& drive,
                            SilverDustParameters& emulated) {
  const double position = reader.number("initial_position", 0.0, -1e6, 1e6);
  emulated.initial_position = static_cast<std::int32_t>(std::lround(drive.transmission.counts(position)));
  emulated.clock_error_ppm = reader.number("clock_error_ppm", 0.0, -1e5, 1e5);
  emulated.tick_phase = host_duration(reader.number("tick_phase", 0.0, 0.0, 0.000119));
  emulated.boot_time = host_duration(reader.number("boot_time", seconds(emulated.boot_time), 0.0, 60.0));
  emulated.turnaround = host_duration(reader.number("turnaround", seconds(emulated.turnaround), 0.0, 1.0));
  emulated.plant.lag_ticks = reader.number("lag_ticks", emulated.plant.lag_ticks, 0.0, 1e4);
}

void parse_emulated_unknowns(ParameterReader& reader, SilverDustParameters& emulated) {
  emulated.address = static_cast<int>(reader.integer("address", emulated.address, 1, 254));
  emulated.revision = static_cast<std::uint16_t>(reader.integer("revision", emulated.revision, 0, 0xFFFF));
  emulated.queue_depth = static_cast<int>(reader.integer("queue_depth", emulated.queue_depth, 1, 16));
  emulated.multi_register_read = reader.boolean("multi_register_read", emulated.multi_register_read);
  emulated.ims_arguments = static_cast<int>(reader.integer("ims_arguments", emulated.ims_arguments, -1, 2));
  emulated.ack_delay = static_cast<int>(reader.integer("ack_delay", emulated.ack_delay, 0, 65535));
  emulated.integration = reader.choice("integration", emulated.integration,
                                       {{"mean_velocity", Integration::MeanVelocity},
                                        {"velocity_first", Integration::VelocityFirst},
                                        {"position_first", Integration::PositionFirst}});
  emulated.acceleration_rounding =
      reader.choice("acceleration_rounding", emulated.acceleration_rounding,
                    {{"truncated", AccelerationRounding::Truncated}, {"exact", AccelerationRounding::Exact}});
  emulated.bad_values =
      reader.choice("bad_values", emulated.bad_values,
                    {{"nak", BadValueReply::Nak}, {"command_error", BadValueReply::CommandError}});
  emulated.disabled_start = reader.choice(
      "disabled_start", emulated.disabled_start,
      {{"command_error", DisabledStartReply::CommandError}, {"busy", DisabledStartReply::Busy}});
}

void parse_emulated(ParameterReader reader, DriveConfiguration& drive) {
  SilverDustParameters& emulated = drive.silverlode.emulated;
  const interpolation::ImsScale& scale = drive.silverlode.scale;
  drive.emulation.missing = reader.boolean("missing", false);
  emulated.address = drive.silverlode.address;
  emulated.counts_per_revolution = static_cast<int>(drive.transmission.counts_per_revolution);
  emulated.velocity_full_scale_rpm = static_cast<int>(scale.velocity_full_scale_rpm);
  emulated.ims_acceleration_full_scale = static_cast<int>(scale.acceleration_full_scale_rpm_per_tick);
  emulated.acceleration_full_scale =
      static_cast<int>(drive.silverlode.command_scale.acceleration_full_scale_rpm_per_tick);
  emulated.tick = host_duration(scale.tick);
  parse_emulated_physics(reader, drive, emulated);
  parse_emulated_unknowns(reader, emulated);
  reader.refuse_unknown();
}

void parse_ims_arguments(ParameterReader& reader, SilverlodeConfiguration& silverlode) {
  silverlode.ims_arguments = reader.text("ims_arguments", silverlode.ims_arguments);
  try {
    silverlode::ims_request(static_cast<std::uint8_t>(silverlode.address), silverlode.ims_arguments);
  } catch (const std::invalid_argument& error) {
    reader.fail("ims_arguments", fmt::format("is \"{}\": {}", silverlode.ims_arguments, error.what()));
  }
}

void parse_queue(ParameterReader& reader, DriveConfiguration& drive) {
  constexpr std::int64_t kMostBlocks = 8;
  SilverlodeConfiguration& silverlode = drive.silverlode;
  silverlode.queue =
      reader.choice("queue", silverlode.queue,
                    {{"fifo", axis::SegmentQueue::Fifo}, {"register", axis::SegmentQueue::Registers}});
  silverlode.queue_depth = static_cast<int>(reader.integer("queue_depth", 0, 0, 16));
  axis::SegmentRegisters& registers = silverlode.segment_registers;
  registers.first = static_cast<std::uint16_t>(
      reader.integer("first_register", registers.first, 0, std::numeric_limits<std::uint16_t>::max()));
  registers.blocks = static_cast<std::size_t>(
      reader.integer("register_blocks", static_cast<std::int64_t>(registers.blocks), 1, kMostBlocks));
  registers.lost_replies = static_cast<int>(reader.integer("lost_replies", registers.lost_replies, 0, 10));
  if (auto wrong = axis::refuse_segment_registers(registers)) reader.fail("first_register", *wrong);
}

}  // namespace

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

void parse_silverlode_drive(ParameterReader& reader, DriveConfiguration& drive) {
  drive.silverlode.address = static_cast<int>(reader.required_integer("address", 1, 254));
  parse_ims_arguments(reader, drive.silverlode);
  parse_queue(reader, drive);
  parse_scales(reader, drive);
  parse_emulated(reader.map("emulation"), drive);
}

}  // namespace interpolated_motion::hardware
