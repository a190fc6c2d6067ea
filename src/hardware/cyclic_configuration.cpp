#include "interpolated_motion_driver/hardware/cyclic_configuration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cyclic/telemetry.h"

namespace interpolated_motion::hardware {

namespace {

constexpr double kLongestPeriod = 0.020;  // s, 0x60C2 of the drives this is for

void parse_emulated(ParameterReader reader, DriveConfiguration& drive) {
  emulation::CyclicParameters& emulated = drive.cyclic.emulated;
  drive.emulation.missing = reader.boolean("missing", false);
  emulated.node_id = static_cast<std::uint8_t>(drive.node_id);
  emulated.serial_number = static_cast<std::uint32_t>(drive.node_id);
  const double position = reader.number("initial_position", 0.0, -1e6, 1e6);
  emulated.initial_position = static_cast<std::int32_t>(std::lround(drive.transmission.counts(position)));
  emulated.clock_error_ppm = reader.number("clock_error_ppm", 0.0, -1e5, 1e5);
  emulated.servo_period = host_duration(drive.cyclic.servo_period);
  emulated.tick_phase =
      host_duration(reader.number("tick_phase", 0.0, 0.0, 0.999 * drive.cyclic.servo_period));
  emulated.boot_time = host_duration(reader.number("boot_time", seconds(emulated.boot_time), 0.001, 60.0));
  emulated.sync_gain = reader.number("sync_gain", emulated.sync_gain, 1e-3, 1.0);
  emulated.interpolation_order =
      static_cast<int>(reader.integer("interpolation_order", drive.cyclic.interpolation_order, 1, 3));
  emulated.ride_through = static_cast<int>(reader.integer("ride_through", emulated.ride_through, 0, 100));
  emulated.plant.lag_ms = reader.number("lag_ms", emulated.plant.lag_ms, 0.0, 1000.0);
  emulated.plant.load_counts = reader.number("load_counts", emulated.plant.load_counts, -1e6, 1e6);
  reader.refuse_unknown();
}

/// Longest frame with `bytes` of data and an 11-bit identifier (Davis et al., "CAN schedulability analysis").
double longest_frame_bits(int bytes) {
  const int stuffed = (34 + 8 * bytes - 1) / 4;
  return 47 + 8 * bytes + stuffed;
}

bool is_period_of_targets(double period) {
  const double ms = period * 1e3;
  return period <= kLongestPeriod + 1e-9 && std::abs(ms - std::round(ms)) < 1e-6;
}

void check_period(const DriveConfiguration& drive, const BusConfiguration& bus) {
  if (!is_period_of_targets(bus.sync_period)) {
    throw std::invalid_argument(
        fmt::format("Parameter buses/{}/sync_period is {}; with the cyclic drive of joint {} on that bus it "
                    "must be a whole number of milliseconds, 0.001..0.02 s (0x60C2).",
                    bus.name, bus.sync_period, drive.joint));
  }
  if (drive.cyclic.servo_period > bus.sync_period) {
    throw std::invalid_argument(
        fmt::format("Parameter drives/{}/servo_period is {} s, longer than the sync_period of bus {} ({} s).",
                    drive.joint, drive.cyclic.servo_period, bus.name, bus.sync_period));
  }
}

}  // namespace

void parse_cyclic_drive(ParameterReader& reader, DriveConfiguration& drive) {
  CyclicConfiguration& cyclic = drive.cyclic;
  cyclic.interpolation_order =
      static_cast<int>(reader.integer("interpolation_order", cyclic.interpolation_order, 1, 3));
  cyclic.servo_period = reader.number("servo_period", cyclic.servo_period, 100e-6, 10e-3);
  cyclic.velocity_unit = reader.number("velocity_unit", cyclic.velocity_unit, 1e-6, 1e9);
  cyclic.acceleration_unit = reader.number("acceleration_unit", cyclic.acceleration_unit, 1e-6, 1e9);
  parse_emulated(reader.map("emulation"), drive);
}

void mark_isochronous_buses(Configuration& configuration) {
  for (const DriveConfiguration& drive : configuration.drives) {
    if (drive.type != DriveType::Cyclic) continue;
    for (BusConfiguration& bus : configuration.buses) {
      if (bus.name != drive.bus) continue;
      check_period(drive, bus);
      bus.isochronous = true;
    }
  }
}

double cyclic_bits_per_sync(const BusConfiguration& bus) {
  const HostDuration period = host_duration(bus.sync_period);
  return longest_frame_bits(4) + longest_frame_bits(7) +
         longest_frame_bits(8) / axis::cyclic_pdo::velocity_interval(period) +
         longest_frame_bits(4) / axis::cyclic_pdo::demand_interval(period);
}

}  // namespace interpolated_motion::hardware
