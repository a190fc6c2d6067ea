#include "interpolated_motion_driver/hardware/epos/configuration.h"

#include <cstdint>

#include "interpolated_motion_driver/hardware/drive_parameters.h"

namespace interpolated_motion::hardware {

namespace {

using namespace emulation;

void parse_identity(ParameterReader& reader, EposParameters& drive) {
  constexpr std::int64_t kU32 = 0xFFFFFFFF;
  drive.variant =
      reader.choice("variant", drive.variant, {{"epos2", EposVariant::Epos2}, {"epos4", EposVariant::Epos4}});
  drive.vendor_id = static_cast<std::uint32_t>(reader.integer("vendor_id", drive.vendor_id, 0, kU32));
  drive.product_code =
      static_cast<std::uint32_t>(reader.integer("product_code", drive.product_code, 0, kU32));
  drive.revision_number =
      static_cast<std::uint32_t>(reader.integer("revision_number", drive.revision_number, 0, kU32));
  drive.serial_number =
      static_cast<std::uint32_t>(reader.integer("serial_number", drive.serial_number, 0, kU32));
}

void parse_physics(ParameterReader& reader, EposParameters& drive) {
  drive.tick_phase = host_duration(reader.number("tick_phase", 0.0, 0.0, 0.000999));
  drive.boot_time = host_duration(reader.number("boot_time", seconds(drive.boot_time), 0.001, 60.0));
  drive.plant.lag_ms = reader.number("lag_ms", drive.plant.lag_ms, 0.0, 1000.0);
  drive.plant.load_counts = reader.number("load_counts", drive.plant.load_counts, -1e6, 1e6);
}

void parse_unknowns(ParameterReader& reader, EposParameters& drive) {
  drive.lowest_velocity_notation = static_cast<std::int8_t>(
      reader.integer("lowest_velocity_notation", drive.lowest_velocity_notation, -3, 0));
  drive.limits_scale_with_notation =
      reader.boolean("limits_scale_with_notation", drive.limits_scale_with_notation);
  drive.limit_ranges_scale_with_notation =
      reader.boolean("limit_ranges_scale_with_notation", drive.limit_ranges_scale_with_notation);
  drive.clock_discipline = reader.boolean("clock_discipline", drive.clock_discipline);
  drive.clock_slew = host_duration(reader.number("clock_slew", seconds(drive.clock_slew), 1e-9, 5e-4));
  drive.time_stamp_pdo_mappable = reader.boolean("time_stamp_pdo_mappable", drive.time_stamp_pdo_mappable);
  drive.free_records_pdo_mappable =
      reader.boolean("free_records_pdo_mappable", drive.free_records_pdo_mappable);
  drive.pdo_setup_only_pre_operational =
      reader.boolean("pdo_setup_only_pre_operational", drive.pdo_setup_only_pre_operational);
  drive.sdo_response_time =
      host_duration(reader.number("sdo_response_time", seconds(drive.sdo_response_time), 0.0, 60.0));
  drive.record_release = reader.choice(
      "record_release", drive.record_release,
      {{"at_segment_end", RecordRelease::AtSegmentEnd}, {"at_segment_start", RecordRelease::AtSegmentStart}});
  drive.underflow_test = reader.choice(
      "underflow_test", drive.underflow_test,
      {{"at_segment_end", UnderflowTest::AtSegmentEnd}, {"every_sample", UnderflowTest::EverySample}});
  drive.motion_check = reader.choice("motion_check", drive.motion_check,
                                     {{"samples", MotionCheck::Samples}, {"knots", MotionCheck::Knots}});
  drive.position_limit_check = reader.choice(
      "position_limit_check", drive.position_limit_check,
      {{"run_time", PositionLimitCheck::RunTime}, {"per_record", PositionLimitCheck::PerRecord}});
  drive.halt_release =
      reader.choice("halt_release", drive.halt_release,
                    {{"resume", HaltRelease::Resume}, {"needs_new_start", HaltRelease::NeedsNewStart}});
}

EposParameters parse_emulated(ParameterReader& reader, const DriveConfiguration& drive) {
  EposParameters emulated;
  emulated.node_id = static_cast<std::uint8_t>(drive.number);
  emulated.serial_number = static_cast<std::uint32_t>(drive.number);
  emulated.counts_per_revolution = static_cast<std::int32_t>(drive.transmission.counts_per_revolution);
  emulated.initial_position = drive.emulation.initial_position;
  parse_identity(reader, emulated);
  parse_physics(reader, emulated);
  parse_unknowns(reader, emulated);
  return emulated;
}

}  // namespace

std::shared_ptr<const EposSettings> parse_epos(ParameterReader& reader, ParameterReader& emulation,
                                               const DriveConfiguration& drive) {
  constexpr double kOfStreams = 8.0;
  auto settings = std::make_shared<EposSettings>();
  settings->stream_deviation_bound =
      parse_stream_deviation_bound(reader, drive, kOfStreams * drive.deviation_bound);
  settings->emulated = parse_emulated(emulation, drive);
  return settings;
}

}  // namespace interpolated_motion::hardware
