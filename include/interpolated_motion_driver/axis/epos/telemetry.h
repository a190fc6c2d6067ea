#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/cia402/cia402_report.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"
#include "interpolated_motion_driver/protocol/cia402/buffer_status.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// How the PDOs of an EPOS drive are used.
///
/// - RPDO1: interpolation data record, as the FIFO needs it
/// - RPDO2: controlword, on change; the drive obeys at the next SYNC
/// - RPDO3: time stamp of SYNC, one frame for all drives of the bus
/// - TPDO1: buffer status, statusword, mode; on change, at most every 2 ms
/// - TPDO2: position, velocity; each SYNC
/// - TPDO3: statusword, buffer status, free records (only if they can be mapped); each SYNC
/// - TPDO4: position demand, following error; each 10th SYNC
namespace epos_pdo {
inline constexpr int kRecordRpdo = 1;
inline constexpr int kControlwordRpdo = 2;
inline constexpr int kTimeStampRpdo = 3;
inline constexpr int kStatusTpdo = 1;
inline constexpr int kMotionTpdo = 2;
inline constexpr int kBufferTpdo = 3;
inline constexpr int kDemandTpdo = 4;

/// How the drive's PDOs are to be set up, for canopen::pdo_configuration(): RPDO1 takes a record when it
/// comes (type 255), RPDO2 the controlword at the next SYNC (type 1).
canopen::PdoConfiguration record_rpdo();
canopen::PdoConfiguration controlword_rpdo();
/// The time stamp of SYNC, with the identifier that all drives of the bus share.
canopen::PdoConfiguration time_stamp_rpdo(std::uint8_t host_node_id);
/// Of the TPDOs. `with_free_records`: the drive lets 0x60C4:02 be mapped.
canopen::PdoConfiguration status_tpdo();
canopen::PdoConfiguration motion_tpdo();
canopen::PdoConfiguration buffer_tpdo(bool with_free_records);
canopen::PdoConfiguration demand_tpdo();
}  // namespace epos_pdo

/// What the drive has told by its TPDOs, in its own units.
struct EposTelemetry : Cia402Report {
  cia402::BufferStatus buffer_status;  ///< 0x20C4:01

  std::int32_t position = 0;  ///< counts
  std::int32_t velocity = 0;  ///< velocity units
  HostTime motion_time{};     ///< latched by the drive: that of the SYNC

  std::uint32_t free_records = 0;  ///< 0x60C4:02 by TPDO3; where that cannot be mapped, by SDO from 0x60C4:04
  HostTime buffer_time{};          ///< latched by the drive: that of the SYNC
  std::uint64_t buffer_reports = 0;  ///< TPDO3s with `free_records` so far: a new one is told by it

  std::int32_t position_demand = 0;  ///< counts
  std::int16_t following_error = 0;  ///< counts
  HostTime demand_time{};            ///< latched by the drive: that of the SYNC

  /// Takes TPDO `number`, received at `time`; `sync` is the time of the last SYNC. Returns false, and takes
  /// nothing, when the frame is too short for its content.
  bool take(int number, const canopen::Frame& frame, HostTime time, HostTime sync);
};

}  // namespace interpolated_motion::axis
