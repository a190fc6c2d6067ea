#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

#include <cmath>

#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {

EposDrive::EposDrive(transport::VirtualCanBus& bus, const EposParameters& parameters, HostTime now)
    : implementation_(std::make_unique<Implementation>(bus, *this, parameters, now)) {
  next_event_ = implementation_->next_event();
}

EposDrive::~EposDrive() = default;

const EposParameters& EposDrive::parameters() const { return implementation_->parameters(); }

EposCounters EposDrive::counters() const { return implementation_->counters(); }

void EposDrive::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
}

std::int32_t EposDrive::position() const {
  return static_cast<std::int32_t>(std::llround(implementation_->plant().position()));
}

void EposDrive::power_cycle(HostTime now, HostDuration off) {
  implementation_->power_cycle(now, off);
  next_event_ = implementation_->next_event();
}

void EposDrive::stall(bool blocked) { implementation_->plant().set_stalled(blocked); }

void EposDrive::set_load(double counts) { implementation_->plant().set_load(counts); }

void EposDrive::raise_fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  implementation_->fault(code, error_register, now);
}

void EposDrive::send_emergency(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  implementation_->emergency(code, error_register, now);
}

void EposDrive::silence(bool silent, HostTime now) { implementation_->silence(silent, now); }

void EposDrive::set_clock_error(double ppm) { implementation_->set_clock_error(ppm); }

void EposDrive::process(HostTime now) {
  implementation_->process(now);
  next_event_ = implementation_->next_event();
}

void EposDrive::on_can_frame(const canopen::Frame& frame, HostTime time) {
  implementation_->on_frame(frame, time);
  next_event_ = implementation_->next_event();
}

}  // namespace interpolated_motion::emulation
