#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/cia402/cia402_report.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// How the PDOs of a cyclic drive are used.
///
/// - RPDO1: target position, and velocity offset where the drive takes one; before each SYNC
/// - RPDO2: controlword, on change; the drive obeys at the next SYNC
/// - RPDO3: torque offset, before each SYNC, where it is asked for and the drive takes one
/// - TPDO1: statusword, mode, position; each SYNC
/// - TPDO2: velocity, following error; about each 10 ms
/// - TPDO3: position demand; about each 100 ms
namespace cyclic_pdo {
inline constexpr int kTargetRpdo = 1;
inline constexpr int kControlwordRpdo = 2;
inline constexpr int kTorqueRpdo = 3;
inline constexpr int kStatusTpdo = 1;
inline constexpr int kVelocityTpdo = 2;
inline constexpr int kDemandTpdo = 3;

/// SYNCs of `period` from one TPDO2, and from one TPDO3, to the next.
int velocity_interval(HostDuration period);
int demand_interval(HostDuration period);

canopen::PdoConfiguration target_rpdo(bool with_velocity_offset);
canopen::PdoConfiguration torque_rpdo();
canopen::PdoConfiguration controlword_rpdo();
canopen::PdoConfiguration status_tpdo();
canopen::PdoConfiguration velocity_tpdo(HostDuration period);
canopen::PdoConfiguration demand_tpdo(HostDuration period);
}  // namespace cyclic_pdo

/// What the drive has told by its TPDOs, in its own units.
struct CyclicTelemetry : Cia402Report {
  std::int32_t position = 0;  ///< counts
  HostTime position_time{};   ///< latched by the drive: that of the SYNC

  std::int32_t velocity = 0;         ///< velocity units
  std::int32_t following_error = 0;  ///< counts
  std::int32_t position_demand = 0;  ///< counts

  /// Takes TPDO `number`, received at `time`; `sync` is the time of the last SYNC. Returns false, and takes
  /// nothing, when the frame is too short for its content.
  bool take(int number, const canopen::Frame& frame, HostTime time, HostTime sync);
};

}  // namespace interpolated_motion::axis
