#pragma once

#include <utility>

#include "interpolated_motion_driver/emulation/canopen/canopen_servo.h"
#include "interpolated_motion_driver/emulation/canopen/device_control.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_objects.h"
#include "interpolated_motion_driver/emulation/cyclic/fine_interpolation.h"
#include "interpolated_motion_driver/emulation/plant.h"

namespace interpolated_motion::emulation {

// Demand and plant count in counts and servo samples inside, the fine interpolation in counts and ms.
class CyclicDrive::Implementation : public CanopenServo {
 public:
  Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                 const CyclicParameters& parameters, HostTime now);

  const CyclicParameters& parameters() const { return parameters_; }
  CyclicCounters counters() const { return {updates_, emergencies(), lost_frames()}; }
  void set_sample_observer(SampleObserver observer) { observer_ = std::move(observer); }
  Plant& plant() override { return plant_; }
  bool has_torque() const override { return on() && device_.power_stage(); }
  void fault(std::uint16_t code, std::uint8_t error_register, HostTime now) override;

 private:
  void booted() override;
  void powered_off() override;
  void sample() override;
  void connection_lost() override;
  void publish_status() override;
  AbortCode check_value(const ObjectEntry& entry, std::int64_t value) const override;
  void written(const ObjectEntry& entry, std::int64_t value) override;

  void controlword(std::uint16_t word);
  void target_position(std::int32_t position);
  void feed_forward();
  void configure_interpolation();
  void enter_mode();
  std::uint16_t statusword() const;

  void move();
  void interpolate();
  void slow_down(double deceleration);
  double ramp(StopRamp stop) const;  // counts/ms^2
  void check_following_error();
  void publish_motion();
  std::uint32_t missed_now() const;
  void observe() const;
  double own_ms() const { return own_time() * servo_ms_; }
  std::int64_t object(std::uint16_t index, std::uint8_t subindex) const;

  const CyclicParameters parameters_;
  const double servo_ms_;  // nominal servo period
  CyclicObjects objects_;
  DeviceControl device_;
  FineInterpolation interpolation_;
  Plant plant_;
  MotionState demand_;               // counts, counts/ms, counts/ms^2
  double following_error_ms_ = 0.0;  // outside the window without a break
  bool following_error_ = false;
  std::uint16_t error_code_ = 0;
  std::uint64_t updates_ = 0;
  double updated_ms_ = -1.0;       // when the newest target position was taken, own clock
  double fed_velocity_ = 0.0;      // counts/ms
  double fed_acceleration_ = 0.0;  // counts/ms^2
  bool feeds_forward_ = false;     // a velocity has come with a target position since the mode was entered
  SampleObserver observer_;
};

}  // namespace interpolated_motion::emulation
