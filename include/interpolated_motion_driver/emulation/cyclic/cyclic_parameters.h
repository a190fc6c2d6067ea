#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/emulation/plant_parameters.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// Settings of an emulated cyclic servo drive.
struct CyclicParameters {
  std::uint8_t node_id = 1;                                 ///< 1..127
  std::string device_name = "Emulated cyclic servo drive";  ///< 0x1008, 1..32 characters
  std::uint32_t vendor_id = 0;                              ///< 0x1018; no vendor's number is claimed
  std::uint32_t product_code = 0x43535038;                  ///< "CSP8"
  std::uint32_t revision_number = 0x00010000;               ///< 0x1018:3
  std::uint32_t serial_number = 1;                          ///< 0x1018:4

  double clock_error_ppm = 0.0;  ///< of its crystal, positive: fast; -100000..100000
  HostDuration servo_period =
      std::chrono::milliseconds(1);  ///< nominal, 100 us .. 10 ms: fine interpolation and plant
  HostDuration tick_phase{};         ///< of the first sample after boot, 0 .. servo_period
  HostDuration boot_time = std::chrono::milliseconds(200);          ///< 1 ms or more
  HostDuration sdo_response_time = std::chrono::microseconds(500);  ///< 0 or more
  bool pdo_setup_only_pre_operational = true;  ///< PDO parameters written in Operational are aborted

  /// Share of a SYNC's deviation from the expected time by which the drive shifts its own grid of updates,
  /// above 0 .. 1; 1: no filter.
  double sync_gain = 0.125;

  int interpolation_order = 3;  ///< 0x2100:1 after boot, 1..3
  int ride_through = 3;         ///< 0x2100:2 after boot, updates, 0..100

  bool takes_offsets = true;   ///< 0x60B1 and 0x60B2 can be mapped into a receive PDO
  double velocity_unit = 1.0;  ///< counts/s in one unit of 0x60B1, > 0
  /// Acceleration that 1 per mille of the rated torque (0x60B2) makes of the axis, counts/s^2, >= 0; 0: the
  /// axis feels none.
  double acceleration_per_torque = 0.0;

  PlantParameters plant;              ///< how the axis follows the demand
  std::int32_t initial_position = 0;  ///< counts
};

/// Throws std::invalid_argument naming node, parameter, value and allowed range when a setting is out of its
/// range.
void validate(const CyclicParameters& parameters);

}  // namespace interpolated_motion::emulation
