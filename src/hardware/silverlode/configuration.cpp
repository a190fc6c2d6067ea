#include "interpolated_motion_driver/hardware/silverlode/configuration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/drive_parameters.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"

namespace interpolated_motion::hardware {

namespace {

using namespace emulation;

void parse_scales(ParameterReader& reader, const DriveConfiguration& drive, SilverlodeSettings& silverlode) {
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

void parse_emulated_physics(ParameterReader& reader, SilverDustParameters& emulated) {
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
  emulated.replies.target_in_motion = reader.boolean("target_in_motion", emulated.replies.target_in_motion);
  emulated.ims_arguments = static_cast<int>(reader.integer("ims_arguments", emulated.ims_arguments, -1, 2));
  emulated.ack_delay = static_cast<int>(reader.integer("ack_delay", emulated.ack_delay, 0, 65535));
  emulated.integration = reader.choice("integration", emulated.integration,
                                       {{"mean_velocity", Integration::MeanVelocity},
                                        {"velocity_first", Integration::VelocityFirst},
                                        {"position_first", Integration::PositionFirst}});
  emulated.acceleration_rounding =
      reader.choice("acceleration_rounding", emulated.acceleration_rounding,
                    {{"truncated", AccelerationRounding::Truncated}, {"exact", AccelerationRounding::Exact}});
  emulated.replies.bad_values =
      reader.choice("bad_values", emulated.replies.bad_values,
                    {{"nak", BadValueReply::Nak}, {"command_error", BadValueReply::CommandError}});
  emulated.replies.segment_writes = reader.choice(
      "segment_writes", emulated.replies.segment_writes,
      {{"moves", SegmentWriteReply::Moves}, {"command_error", SegmentWriteReply::CommandError}});
  emulated.replies.disabled_start = reader.choice(
      "disabled_start", emulated.replies.disabled_start,
      {{"command_error", DisabledStartReply::CommandError}, {"busy", DisabledStartReply::Busy}});
}

void parse_emulated(ParameterReader& reader, const DriveConfiguration& drive,
                    SilverlodeSettings& silverlode) {
  SilverDustParameters& emulated = silverlode.emulated;
  const interpolation::ImsScale& scale = silverlode.scale;
  emulated.address = drive.number;
  emulated.initial_position = drive.emulation.initial_position;
  emulated.counts_per_revolution = static_cast<int>(drive.transmission.counts_per_revolution);
  emulated.velocity_full_scale_rpm = static_cast<int>(scale.velocity_full_scale_rpm);
  emulated.ims_acceleration_full_scale = static_cast<int>(scale.acceleration_full_scale_rpm_per_tick);
  emulated.acceleration_full_scale =
      static_cast<int>(silverlode.command_scale.acceleration_full_scale_rpm_per_tick);
  emulated.tick = host_duration(scale.tick);
  parse_emulated_physics(reader, emulated);
  parse_emulated_unknowns(reader, emulated);
}

void parse_ims_arguments(ParameterReader& reader, int address, SilverlodeSettings& silverlode) {
  silverlode.ims_arguments = reader.text("ims_arguments", silverlode.ims_arguments);
  try {
    silverlode::ims_request(static_cast<std::uint8_t>(address), silverlode.ims_arguments);
  } catch (const std::invalid_argument& error) {
    reader.fail("ims_arguments", fmt::format("is \"{}\": {}", silverlode.ims_arguments, error.what()));
  }
}

void parse_queue(ParameterReader& reader, SilverlodeSettings& silverlode) {
  constexpr std::int64_t kMostBlocks = 8;
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

/// Segments are long beside the time between two setpoints; so how far off they are is a matter of the motion
/// and not of the encoder.
double default_stream_bound(const DriveConfiguration& drive) {
  constexpr double kAtTheJoint = 0.02;  // rad, or what in_unit() makes of it
  return trajectory::in_unit(drive.limits.unit, kAtTheJoint) *
         std::abs(drive.transmission.counts_per_radian());
}

}  // namespace

std::shared_ptr<const SilverlodeSettings> parse_silverlode(ParameterReader& reader,
                                                           ParameterReader& emulation,
                                                           const DriveConfiguration& drive) {
  auto settings = std::make_shared<SilverlodeSettings>();
  settings->stream_deviation_bound = parse_stream_deviation_bound(reader, drive, default_stream_bound(drive));
  parse_ims_arguments(reader, drive.number, *settings);
  parse_queue(reader, *settings);
  settings->target_in_motion = reader.boolean("target_in_motion", settings->target_in_motion);
  parse_scales(reader, drive, *settings);
  parse_emulated(emulation, drive, *settings);
  return settings;
}

void check_common_start(const DriveConfiguration& drive, const Configuration& all) {
  if (all.bus_of(drive).serial.start != LineStartKind::Global) return;
  const auto found =
      std::find_if(all.drives.begin(), all.drives.end(), [&drive](const DriveConfiguration& other) {
        return other.bus == drive.bus && other.kind == drive.kind;
      });
  const std::string& arguments = settings_of<SilverlodeSettings>(drive).ims_arguments;
  const std::string& first = settings_of<SilverlodeSettings>(*found).ims_arguments;
  if (arguments == first) return;
  throw std::invalid_argument(fmt::format(
      "Parameter drives/{}/ims_arguments is \"{}\", that of joint {} is \"{}\": with buses/{}/start: global "
      "one command starts both. Give all drives of the bus the same, or set start to addressed.",
      drive.joint, arguments, found->joint, first, drive.bus));
}

}  // namespace interpolated_motion::hardware
