#include "interpolated_motion_driver/axis/epos/record_sender.h"

#include "interpolated_motion_driver/axis/epos/telemetry.h"
#include "interpolated_motion_driver/protocol/cia402/interpolation_data_record.h"

namespace interpolated_motion::axis {

void RecordSender::begin() { due_ = node_.rpdos_confirmed(epos_pdo::kRecordRpdo); }

void RecordSender::send(HostTime now) {
  while (const auto record = feed_.next(clock_.least_elapsed(now), clock_.elapsed(now))) {
    const auto bytes = cia402::pack({record->position, record->velocity, record->time});
    if (!node_.send_record(epos_pdo::kRecordRpdo, bytes.data(), static_cast<std::uint8_t>(bytes.size())))
      return;
    feed_.mark_sent();
    ++due_;
    ++sent_;
  }
}

bool RecordSender::all_on_bus() const { return node_.rpdos_confirmed(epos_pdo::kRecordRpdo) >= due_; }

HostTime RecordSender::last_time() const { return node_.last_rpdo_time(epos_pdo::kRecordRpdo); }

}  // namespace interpolated_motion::axis
