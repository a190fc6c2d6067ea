#include "interpolated_motion_driver/hardware/cyclic/configuration.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/drive_parameters.h"

namespace interpolated_motion::hardware {

namespace {

constexpr double kOfStreams = 8.0;        // of deviation_bound, where it is not given
constexpr double kLongestPeriod = 0.020;  // s, 0x60C2 of the drives this is for

void parse_emulated(ParameterReader& reader, const DriveConfiguration& drive, CyclicSettings& settings) {
  emulation::CyclicParameters& emulated = settings.emulated;
  emulated.node_id = static_cast<std::uint8_t>(drive.number);
  emulated.serial_number = static_cast<std::uint32_t>(drive.number);
  emulated.initial_position = drive.emulation.initial_position;
  emulated.servo_period = host_duration(settings.servo_period);
  emulated.tick_phase = host_duration(reader.number("tick_phase", 0.0, 0.0, 0.999 * settings.servo_period));
  emulated.boot_time = host_duration(reader.number("boot_time", seconds(emulated.boot_time), 0.001, 60.0));
  emulated.sdo_response_time =
      host_duration(reader.number("sdo_response_time", seconds(emulated.sdo_response_time), 0.0, 60.0));
  emulated.pdo_setup_only_pre_operational =
      reader.boolean("pdo_setup_only_pre_operational", emulated.pdo_setup_only_pre_operational);
  emulated.sync_gain = reader.number("sync_gain", emulated.sync_gain, 1e-3, 1.0);
  emulated.interpolation_order =
      static_cast<int>(reader.integer("interpolation_order", settings.interpolation_order, 1, 3));
  emulated.ride_through = static_cast<int>(reader.integer("ride_through", emulated.ride_through, 0, 100));
  emulated.plant.lag_ms = reader.number("lag_ms", emulated.plant.lag_ms, 0.0, 1000.0);
  emulated.takes_offsets = reader.boolean("takes_offsets", emulated.takes_offsets);
  emulated.acceleration_per_torque =
      reader.number("acceleration_per_torque", emulated.acceleration_per_torque, 0.0, 1e12);
  emulated.velocity_unit = settings.velocity_unit;
  emulated.plant.load_counts = reader.number("load_counts", emulated.plant.load_counts, -1e6, 1e6);
}

bool is_period_of_targets(double period) {
  const double ms = period * 1e3;
  return period <= kLongestPeriod + 1e-9 && std::abs(ms - std::round(ms)) < 1e-6;
}

}  // namespace

std::shared_ptr<const CyclicSettings> parse_cyclic(ParameterReader& reader, ParameterReader& emulation,
                                                   const DriveConfiguration& drive) {
  auto settings = std::make_shared<CyclicSettings>();
  CyclicSettings& cyclic = *settings;
  cyclic.interpolation_order =
      static_cast<int>(reader.integer("interpolation_order", cyclic.interpolation_order, 1, 3));
  cyclic.stream_deviation_bound =
      parse_stream_deviation_bound(reader, drive, kOfStreams * drive.deviation_bound);
  cyclic.servo_period = reader.number("servo_period", cyclic.servo_period, 100e-6, 10e-3);
  cyclic.velocity_unit = reader.number("velocity_unit", cyclic.velocity_unit, 1e-6, 1e9);
  cyclic.acceleration_unit = reader.number("acceleration_unit", cyclic.acceleration_unit, 1e-6, 1e9);
  cyclic.velocity_feedforward = reader.boolean("velocity_feedforward", cyclic.velocity_feedforward);
  cyclic.torque_per_acceleration =
      reader.number("torque_per_acceleration", cyclic.torque_per_acceleration, 0.0, 1e6);
  parse_emulated(emulation, drive, cyclic);
  return settings;
}

void check_sync_period(const DriveConfiguration& drive, const BusConfiguration& bus) {
  if (!is_period_of_targets(bus.sync_period)) {
    throw std::invalid_argument(
        fmt::format("Parameter buses/{}/sync_period is {}; with the cyclic drive of joint {} on that bus it "
                    "must be a whole number of milliseconds, 0.001..0.02 s (0x60C2).",
                    bus.name, bus.sync_period, drive.joint));
  }
  const double servo_period = settings_of<CyclicSettings>(drive).servo_period;
  if (servo_period > bus.sync_period) {
    throw std::invalid_argument(
        fmt::format("Parameter drives/{}/servo_period is {} s, longer than the sync_period of bus {} ({} s).",
                    drive.joint, servo_period, bus.name, bus.sync_period));
  }
}

}  // namespace interpolated_motion::hardware
