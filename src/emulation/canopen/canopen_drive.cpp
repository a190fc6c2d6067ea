#include "interpolated_motion_driver/emulation/canopen/canopen_drive.h"

#include <cmath>

namespace interpolated_motion::emulation {
namespace {

constexpr FaultNumber kErrorCode{"CODE", 1.0, 0xFFFF};  // 0 is the end of an error

/// The bit of 0x1001 that the class of an error code belongs to (CiA 301, tables 22 and 26); generic is set
/// with every error.
std::uint8_t error_register_of(std::uint16_t code) {
  constexpr std::uint8_t kGeneric = 0x01;
  constexpr std::uint8_t kCurrent = 0x02;
  constexpr std::uint8_t kVoltage = 0x04;
  constexpr std::uint8_t kTemperature = 0x08;
  constexpr std::uint8_t kCommunication = 0x10;
  constexpr std::uint8_t kProfile = 0x20;
  switch (code >> 12) {
    case 2:
      return kGeneric | kCurrent;
    case 3:
      return kGeneric | kVoltage;
    case 4:
      return kGeneric | kTemperature;
    case 7:
      return kGeneric | kProfile;
    case 8:
      return kGeneric | ((code >> 8) <= 0x82 ? kCommunication : kProfile);
    default:
      return kGeneric;
  }
}

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
  using Numbers = FaultCommand::Numbers;
  const auto code_of = [](const Numbers& n) { return static_cast<std::uint16_t>(n[0]); };
  return {{"emcy",
           {kErrorCode},
           [this, now, code_of](const Numbers& n) {
             raise_fault(code_of(n), error_register_of(code_of(n)), now);
           }},
          {"warning",
           {kErrorCode},
           [this, now, code_of](const Numbers& n) {
             send_emergency(code_of(n), error_register_of(code_of(n)), now);
           }},
          {"warning_over", {}, [this, now](const Numbers&) { send_emergency(0, 0, now); }}};
}

}  // namespace interpolated_motion::emulation
