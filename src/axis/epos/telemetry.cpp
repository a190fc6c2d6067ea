#include "interpolated_motion_driver/axis/epos/telemetry.h"

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

using canopen::get_le;
using canopen::PdoDirection;

namespace epos_pdo {

namespace entry = cia402::pdo_entry;

namespace {

/// TPDO1 follows every change of the statusword, yet must not flood the bus: 2 ms, in units of 100 us.
constexpr std::uint16_t kStatusInhibitTime = 20;
/// Every 10th SYNC: for display, and to know where the drive rests.
constexpr std::uint8_t kTenthSync = 10;

canopen::PdoConfiguration pdo(PdoDirection direction, int number, std::vector<canopen::PdoEntry> entries,
                              std::uint8_t type) {
  canopen::PdoConfiguration configuration;
  configuration.direction = direction;
  configuration.number = number;
  configuration.mapping.entries = std::move(entries);
  configuration.transmission_type = type;
  return configuration;
}

}  // namespace

canopen::PdoConfiguration record_rpdo() {
  return pdo(PdoDirection::Rpdo, kRecordRpdo, {entry::kInterpolationRecord}, canopen::kEventDriven);
}

canopen::PdoConfiguration controlword_rpdo() {
  return pdo(PdoDirection::Rpdo, kControlwordRpdo, {entry::kControlword}, canopen::kSynchronous);
}

canopen::PdoConfiguration time_stamp_rpdo(std::uint8_t host_node_id) {
  auto configuration = pdo(PdoDirection::Rpdo, kTimeStampRpdo, {entry::kTimeStamp}, canopen::kEventDriven);
  configuration.cob_id = canopen::cob_id::time_stamp(host_node_id);
  return configuration;
}

canopen::PdoConfiguration status_tpdo() {
  auto configuration =
      pdo(PdoDirection::Tpdo, kStatusTpdo, {entry::kBufferStatus, entry::kStatusword, entry::kModeDisplay},
          canopen::kEventDriven);
  configuration.inhibit_time = kStatusInhibitTime;
  return configuration;
}

canopen::PdoConfiguration motion_tpdo() {
  return pdo(PdoDirection::Tpdo, kMotionTpdo, {entry::kPositionActual, entry::kVelocityActual},
             canopen::kSynchronous);
}

canopen::PdoConfiguration buffer_tpdo(bool with_free_records) {
  std::vector<canopen::PdoEntry> entries{entry::kStatusword, entry::kBufferStatus};
  if (with_free_records) entries.push_back(entry::kFreeRecords);
  return pdo(PdoDirection::Tpdo, kBufferTpdo, std::move(entries), canopen::kSynchronous);
}

canopen::PdoConfiguration demand_tpdo() {
  return pdo(PdoDirection::Tpdo, kDemandTpdo, {entry::kPositionDemand, entry::kFollowingError}, kTenthSync);
}

}  // namespace epos_pdo

bool EposTelemetry::take(int number, const canopen::Frame& frame, HostTime time, HostTime sync) {
  const std::uint8_t* data = frame.data.data();
  switch (number) {
    case epos_pdo::kStatusTpdo:
      if (frame.length < 5) return false;
      buffer_status.raw = get_le<std::uint16_t>(data);
      statusword.raw = get_le<std::uint16_t>(data + 2);
      mode = get_le<std::int8_t>(data + 4);
      status_time = time;
      return true;
    case epos_pdo::kMotionTpdo:
      if (frame.length < 8) return false;
      position = get_le<std::int32_t>(data);
      velocity = get_le<std::int32_t>(data + 4);
      motion_time = sync;
      return true;
    case epos_pdo::kBufferTpdo:
      if (frame.length < 4) return false;
      statusword.raw = get_le<std::uint16_t>(data);
      buffer_status.raw = get_le<std::uint16_t>(data + 2);
      status_time = time;
      if (frame.length < 8) return true;
      free_records = get_le<std::uint32_t>(data + 4);
      buffer_time = sync;
      ++buffer_reports;
      return true;
    case epos_pdo::kDemandTpdo:
      if (frame.length < 6) return false;
      position_demand = get_le<std::int32_t>(data);
      following_error = get_le<std::int16_t>(data + 4);
      demand_time = sync;
      return true;
    default:
      return false;
  }
}

}  // namespace interpolated_motion::axis
