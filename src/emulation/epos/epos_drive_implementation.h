#pragma once

#include <optional>
#include <utility>

#include "interpolated_motion_driver/emulation/canopen/canopen_servo.h"
#include "interpolated_motion_driver/emulation/canopen/device_control.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_objects.h"
#include "interpolated_motion_driver/emulation/epos/interpolated_position_mode.h"
#include "interpolated_motion_driver/emulation/plant.h"

namespace interpolated_motion::emulation {

// The parts of the drive put together. Three source files: states and commands
// (epos_drive_implementation.cpp), objects and what writing them does (epos_drive_objects.cpp), the 1 ms
// sample (epos_drive_sample.cpp).
class EposDrive::Implementation : public CanopenServo {
 public:
  Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                 const EposParameters& parameters, HostTime now);

  const EposParameters& parameters() const { return parameters_; }
  EposCounters counters() const;
  void set_sample_observer(SampleObserver observer) { observer_ = std::move(observer); }
  Plant& plant() override { return plant_; }
  bool has_torque() const override { return on() && device_.power_stage(); }
  void fault(std::uint16_t code, std::uint8_t error_register, HostTime now) override;

 private:
  // epos_drive_implementation.cpp
  void booted() override;
  void powered_off() override;
  void connection_lost() override;
  void heartbeat_heard() override;
  void publish_status() override;
  void controlword(std::uint16_t word);
  void select_mode(int mode);
  void command_interpolation(bool enabled, bool was_enabled);
  void stop_interpolation();
  std::uint16_t statusword() const;
  int mode() const;

  // epos_drive_objects.cpp
  ObjectDictionary::Values initial_values() const override;
  AbortCode check_value(const ObjectEntry& entry, std::int64_t value) const override;
  std::optional<AbortCode> divert(const ObjectEntry& entry, std::uint64_t raw) override;
  void written(const ObjectEntry& entry, std::int64_t value) override;
  AbortCode take_record(std::uint64_t raw);
  RecordPolicy record_policy() const;
  void store_parameters() { stored_ = objects_.values(); }
  void restore_parameters(std::uint8_t subindex);
  void restore_cob_ids();
  void update_limits();

  // epos_drive_sample.cpp
  void sample() override;
  void move();
  void interpolate();
  void begin_interpolation();
  void handle(InterpolationEvent event);
  void slow_down(double deceleration);
  void stop_at_once();
  double ramp_deceleration() const;
  void check_following_error();
  void watch_position_window();
  void publish_motion();
  void observe();

  const EposParameters parameters_;
  EposObjects objects_;
  std::optional<ObjectDictionary::Values> stored_;
  DeviceControl device_;
  std::uint16_t fault_code_ = 0;  ///< of the EMCY message of the last fault
  InterpolatedPositionMode ip_;
  Plant plant_;

  bool start_requested_ = false;
  bool ip_bit_ = false;
  bool halt_ = false;
  bool halted_ = false;
  bool interpolated_sample_ = false;
  bool connection_error_ = false;
  std::int64_t window_ms_ = 0;
  MotionState demand_;
  double profile_deceleration_ = 0.0;
  double quick_stop_deceleration_ = 0.0;
  double velocity_units_ = 0.0;

  SampleObserver observer_;
  EposCounters counters_;
};

}  // namespace interpolated_motion::emulation
