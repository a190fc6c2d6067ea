#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"

#include <cmath>

#include "cyclic_drive_implementation.h"

namespace interpolated_motion::emulation {

CyclicDrive::CyclicDrive(transport::VirtualCanBus& bus, const CyclicParameters& parameters, HostTime now)
    : implementation_(std::make_unique<Implementation>(bus, *this, parameters, now)) {
  next_event_ = implementation_->next_event();
}

CyclicDrive::~CyclicDrive() = default;

const CyclicParameters& CyclicDrive::parameters() const { return implementation_->parameters(); }

CyclicCounters CyclicDrive::counters() const { return implementation_->counters(); }

void CyclicDrive::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
}

std::int32_t CyclicDrive::position() const {
  return static_cast<std::int32_t>(std::llround(implementation_->plant().position()));
}

void CyclicDrive::power_cycle(HostTime now, HostDuration off) {
  implementation_->power_cycle(now, off);
  next_event_ = implementation_->next_event();
}

void CyclicDrive::stall(bool blocked) { implementation_->plant().set_stalled(blocked); }

void CyclicDrive::set_load(double counts) { implementation_->plant().set_load(counts); }

void CyclicDrive::raise_fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  implementation_->fault(code, error_register, now);
}

void CyclicDrive::silence(bool silent, HostTime now) { implementation_->silence(silent, now); }

void CyclicDrive::set_clock_error(double ppm) { implementation_->set_clock_error(ppm); }

void CyclicDrive::process(HostTime now) {
  implementation_->process(now);
  next_event_ = implementation_->next_event();
}

void CyclicDrive::on_can_frame(const canopen::Frame& frame, HostTime time) {
  implementation_->on_frame(frame, time);
  next_event_ = implementation_->next_event();
}

}  // namespace interpolated_motion::emulation
