#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/hardware/drive_kinds.h"
#include "interpolated_motion_driver/hardware/mechanism.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::hardware {

/// What only drives of one kind have. Each kind derives its own and knows it again, see settings_of().
struct DriveSettings {
  virtual ~DriveSettings() = default;
};

/// What the emulated drive of a joint does differently from a perfect one, whatever its kind.
struct DriveEmulation {
  bool missing = false;               ///< there is no such drive on the bus
  Mechanism mechanism;                ///< between joint and encoder; where none is told, the transmission
  std::int32_t initial_position = 0;  ///< counts, at power-up
  double clock_error_ppm = 0.0;       ///< of its crystal, positive: fast
};

/// A joint's drive.
struct DriveConfiguration {
  std::string joint;                    ///< its key under `drives`
  std::string bus;                      ///< key under `buses`, see Configuration::bus_of()
  const DriveKind* kind = nullptr;      ///< the one object of its kind; never null once it has been parsed
  int number = 0;                       ///< node id, 1..127, or address on a SilverLode line, 1..254
  encoding::Transmission transmission;  ///< between joint units and counts
  trajectory::JointLimits limits;       ///< URDF limits, tightened by the configuration
  double deviation_bound = 1.0;         ///< counts, worst deviation from the path at any drive sample
  double max_following_error = 0.1;     ///< rad or m, beyond it the drive faults (0x6065, ERL)
  /// 1..limit_margin; a plan may exceed the joint's velocity and acceleration by this factor
  double plan_margin = 1.01;
  double limit_margin = 1.2;  ///< 1..10; what the drive is given may exceed the joint's limits by this factor
  DriveEmulation emulation;   ///< without meaning where the bus is not emulated
  std::shared_ptr<const DriveSettings> settings;  ///< of its kind
};

/// The settings of a drive, for its own kind.
template <class Settings>
const Settings& settings_of(const DriveConfiguration& drive) {
  return static_cast<const Settings&>(*drive.settings);
}

/// Limits of each joint, as the URDF has them.
using UrdfLimits = std::map<std::string, trajectory::JointLimits>;

/// Reads `drives/<joint>`; its `type` is one of `kinds`. Throws like ParameterReader.
DriveConfiguration parse_drive(const std::string& joint, ParameterReader reader, const UrdfLimits& urdf,
                               const DriveKinds& kinds);

}  // namespace interpolated_motion::hardware
