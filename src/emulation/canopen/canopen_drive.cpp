#include "interpolated_motion_driver/emulation/canopen/canopen_drive.h"

#include <cmath>

namespace interpolated_motion::emulation {
namespace {

constexpr FaultNumber kErrorCode{"CODE", 1.0, 0xFFFF};  // 0 is the end of an error
constexpr std::uint8_t kGenericError = 0x01;            // of 0x1001, CiA 301

}  // namespace

void CanopenDrive::consist_of(CanopenServo& servo) {
  servo_ = &servo;
  next_event_ = servo.next_event();
}

void CanopenDrive::process(HostTime now) {
  servo_->process(now);
  next_event_ = servo_->next_event();
}

void CanopenDrive::on_can_frame(const canopen::Frame& frame, HostTime time) {
  servo_->on_frame(frame, time);
  next_event_ = servo_->next_event();
}

std::int32_t CanopenDrive::position() const {
  return static_cast<std::int32_t>(std::llround(servo_->plant().position()));
}

bool CanopenDrive::has_torque() const { return servo_->has_torque(); }

void CanopenDrive::power_cycle(HostTime now, HostDuration off) {
  servo_->power_cycle(now, off);
  next_event_ = servo_->next_event();
}

void CanopenDrive::stall(bool blocked) { servo_->plant().set_stalled(blocked); }

void CanopenDrive::silence(bool silent, HostTime now) { servo_->silence(silent, now); }

void CanopenDrive::set_clock_error(double ppm) { servo_->set_clock_error(ppm); }

void CanopenDrive::set_load(double counts) { servo_->plant().set_load(counts); }

void CanopenDrive::raise_fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  servo_->fault(code, error_register, now);
}

void CanopenDrive::send_emergency(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  servo_->emergency(code, error_register, now);
}

std::vector<FaultCommand> CanopenDrive::own_faults(HostTime now) {
  return {{"emcy", {kErrorCode}, [this, now](const FaultCommand::Numbers& n) {
             raise_fault(static_cast<std::uint16_t>(n[0]), kGenericError, now);
           }}};
}

}  // namespace interpolated_motion::emulation
