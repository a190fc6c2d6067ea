#include "interpolated_motion_driver/axis/cyclic/telemetry.h"

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

using canopen::get_le;
using canopen::PdoDirection;

namespace cyclic_pdo {

namespace entry = cia402::pdo_entry;

namespace {

constexpr HostDuration kVelocityPeriod = std::chrono::milliseconds(10);
constexpr HostDuration kDemandPeriod = std::chrono::milliseconds(100);

int syncs_in(HostDuration interval, HostDuration period) {
  return static_cast<int>(std::clamp<HostDuration::rep>(interval / period, 1, 240));
}

canopen::PdoConfiguration synchronous(PdoDirection direction, int number,
                                      std::vector<canopen::PdoEntry> entries, int each_sync = 1) {
  canopen::PdoConfiguration configuration;
  configuration.direction = direction;
  configuration.number = number;
  configuration.mapping.entries = std::move(entries);
  configuration.transmission_type = static_cast<std::uint8_t>(each_sync);
  return configuration;
}

}  // namespace

int velocity_interval(HostDuration period) { return syncs_in(kVelocityPeriod, period); }

int demand_interval(HostDuration period) { return syncs_in(kDemandPeriod, period); }

canopen::PdoConfiguration target_rpdo(bool with_velocity_offset) {
  std::vector<canopen::PdoEntry> entries{entry::kTargetPosition};
  if (with_velocity_offset) entries.push_back(entry::kVelocityOffset);
  return synchronous(PdoDirection::Rpdo, kTargetRpdo, std::move(entries));
}

canopen::PdoConfiguration torque_rpdo() {
  return synchronous(PdoDirection::Rpdo, kTorqueRpdo, {entry::kTorqueOffset});
}

canopen::PdoConfiguration controlword_rpdo() {
  return synchronous(PdoDirection::Rpdo, kControlwordRpdo, {entry::kControlword});
}

canopen::PdoConfiguration status_tpdo() {
  return synchronous(PdoDirection::Tpdo, kStatusTpdo,
                     {entry::kStatusword, entry::kModeDisplay, entry::kPositionActual});
}

canopen::PdoConfiguration velocity_tpdo(HostDuration period) {
  return synchronous(PdoDirection::Tpdo, kVelocityTpdo,
                     {entry::kVelocityActual, entry::kFollowingErrorActual}, velocity_interval(period));
}

canopen::PdoConfiguration demand_tpdo(HostDuration period) {
  return synchronous(PdoDirection::Tpdo, kDemandTpdo, {entry::kPositionDemand}, demand_interval(period));
}

}  // namespace cyclic_pdo

bool CyclicTelemetry::take(int number, const canopen::Frame& frame, HostTime time, HostTime sync) {
  const std::uint8_t* data = frame.data.data();
  switch (number) {
    case cyclic_pdo::kStatusTpdo:
      if (frame.length < 7) return false;
      statusword.raw = get_le<std::uint16_t>(data);
      mode = get_le<std::int8_t>(data + 2);
      position = get_le<std::int32_t>(data + 3);
      status_time = time;
      position_time = sync;
      return true;
    case cyclic_pdo::kVelocityTpdo:
      if (frame.length < 8) return false;
      velocity = get_le<std::int32_t>(data);
      following_error = get_le<std::int32_t>(data + 4);
      return true;
    case cyclic_pdo::kDemandTpdo:
      if (frame.length < 4) return false;
      position_demand = get_le<std::int32_t>(data);
      return true;
    default:
      return false;
  }
}

}  // namespace interpolated_motion::axis
