#include "interpolated_motion_driver/axis/cia402/drive_errors.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::SdoResult;
using Failure = std::optional<std::string>;

namespace {

constexpr std::uint16_t kGenericError = 0x1000;  // CiA 301, table 22

}  // namespace

void DriveErrors::collect(canopen::NodeLink& node, HostTime now) {
  while (const auto emcy = node.take_emcy()) take(*emcy, now);
}

void DriveErrors::take(const canopen::Emcy& emcy, HostTime now) {
  const std::uint8_t error_register = emcy.error_register;
  if (emcy.code == cia402::emergency_code::kReset && error_register == 0) return end(now);
  if (emcy.code == cia402::emergency_code::kReset) {
    return note(false,
                fmt::format("an error of the drive is over, others remain (error register 0x{:02X}: {})",
                            error_register, cia402::error_register_text(error_register)),
                now);
  }
  if (emcy.code == code_ && device_.text_of(emcy) == text_) return;
  set(emcy);
  note(true, "the drive reports " + text_, now);
}

void DriveErrors::set(const canopen::Emcy& emcy) {
  const bool is_first = code_ == 0;
  code_ = emcy.code;
  text_ = device_.text_of(emcy);
  if (is_first) first_ = text_;
}

void DriveErrors::end(HostTime now) {
  if (code_ == 0) return;
  code_ = 0;
  note(false, "the error of the drive is over: " + std::exchange(text_, {}), now);
}

SdoSequence::Step DriveErrors::read(HostTime now) {
  return SdoSequence::read(object::kErrorRegister, [this, now](const SdoResult& r) -> Failure {
    if (!r.ok) return std::nullopt;
    if (r.as_u8() == 0) {
      end(now);
    } else {
      sequence_.insert({read_newest(r.as_u8(), now)});
    }
    return std::nullopt;
  });
}

SdoSequence::Step DriveErrors::read_newest(std::uint8_t error_register, HostTime now) {
  return SdoSequence::read(object::kErrorHistoryNewest,
                           [this, error_register, now](const SdoResult& r) -> Failure {
                             take_read(error_register, r.ok ? r.as_u32() : 0, now);
                             return std::nullopt;
                           });
}

void DriveErrors::take_read(std::uint8_t error_register, std::uint32_t newest, HostTime now) {
  if (code_ != 0) return;
  canopen::Emcy emcy;
  emcy.code = static_cast<std::uint16_t>(newest);
  emcy.error_register = error_register;
  if (emcy.code == 0) emcy.code = kGenericError;
  set(emcy);
  note(true, "the drive has an error of which no message has come: " + text_, now);
}

void DriveErrors::note(bool is_problem, const std::string& text, HostTime now) {
  notes_.add({is_problem, fmt::format("{}: {}.", who_(), text)}, now);
}

}  // namespace interpolated_motion::axis
