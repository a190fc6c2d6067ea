#include "interpolated_motion_driver/hardware/bus_link.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::hardware {

namespace {

/// A disturbed bus reports thousands of errors a second; the log gets one at most in this time.
constexpr HostDuration kErrorNotePeriod = std::chrono::seconds(1);

}  // namespace

void BusLink::follow_device(HostTime now, EventLog& log) {
  if (!device_) return;
  if (device_->poll(now)) note_change(log);
  note_errors(now, log);
  device_->watch();
}

// What was queued before the device was looked at for the first time is not old.
void BusLink::note_change(EventLog& log) {
  if (std::exchange(followed_, true)) clear_outgoing();
  const Severity severity = device_->usable() ? Severity::Info : Severity::Error;
  log.add(severity, fmt::format("Bus {}: {}", name(), device_->status()));
  if (!device_->usable()) return;
  for (const std::string& advice : device_->advice())
    log.add(Severity::Info, fmt::format("Bus {}, advice: {}", name(), advice));
}

void BusLink::note_errors(HostTime now, EventLog& log) {
  while (const auto error = device_->take_error()) {
    if (now < next_error_note_) {
      ++errors_not_noted_;
      continue;
    }
    next_error_note_ = now + kErrorNotePeriod;
    const std::uint64_t skipped = std::exchange(errors_not_noted_, 0);
    const std::string more = skipped > 0 ? fmt::format(" ({} more before)", skipped) : "";
    log.add(Severity::Warning, fmt::format("Bus {}: the controller reports: {}{}", name(), *error, more));
  }
}

void BusLink::send(HostTime now) { is_down() ? clear_outgoing() : send_outgoing(now); }

HostTime BusLink::next_deadline() const {
  return device_ ? std::min(master_deadline(), device_->next_deadline()) : master_deadline();
}

std::string BusLink::fault() const {
  return is_down() ? fmt::format("Bus {} cannot be used ({}).", name(), device_->status()) : std::string();
}

void BusLink::snapshot(motion::BusSnapshot& out) const {
  out.name = name();
  out.unexpected = unexpected();
  fill_traffic(out);
  if (!device_) {
    out.state = "emulated";
    return;
  }
  out.usable = device_->usable();
  out.state = device_->status();
  out.error_frames = device_->error_frames();
  out.lost_frames = device_->lost_frames();
}

}  // namespace interpolated_motion::hardware
