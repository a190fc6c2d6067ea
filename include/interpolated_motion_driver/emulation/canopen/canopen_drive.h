#pragma once

#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/emulation/canopen/canopen_servo.h"
#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// An emulated drive on CANopen, whatever its kind: what a world does with the node that it consists of. The
/// command of all these drives: `emcy CODE` (an error with fault reaction).
class CanopenDrive : public Drive, public transport::CanListener {
 public:
  CanopenDrive(const CanopenDrive&) = delete;
  CanopenDrive& operator=(const CanopenDrive&) = delete;

  HostTime next_event() const override { return next_event_; }
  void process(HostTime now) override;
  void on_can_frame(const canopen::Frame& frame, HostTime time) override;

  std::int32_t position() const override;
  bool has_torque() const override;

  void power_cycle(HostTime now, HostDuration off) override;
  void stall(bool blocked) override;
  void silence(bool silent, HostTime now) override;
  void set_clock_error(double ppm) override;

  /// Changes the external load: a standing deviation of the axis in counts.
  void set_load(double counts);

  /// Reports the error `code` in an EMCY message and goes into fault reaction. Error register bits as in CiA
  /// 301.
  void raise_fault(std::uint16_t code, std::uint8_t error_register, HostTime now);

  /// Sends an EMCY message without any other reaction.
  void send_emergency(std::uint16_t code, std::uint8_t error_register, HostTime now);

 protected:
  CanopenDrive() = default;

  /// To be called by each constructor. `servo` listens by means of this object, and must live as long.
  void consist_of(CanopenServo& servo);

 private:
  std::vector<FaultCommand> own_faults(HostTime now) override;

  CanopenServo* servo_ = nullptr;
  HostTime next_event_ = kNever;
};

}  // namespace interpolated_motion::emulation
