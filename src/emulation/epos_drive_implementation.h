#pragma once

#include <deque>
#include <optional>

#include "interpolated_motion_driver/emulation/device_control.h"
#include "interpolated_motion_driver/emulation/epos_drive.h"
#include "interpolated_motion_driver/emulation/epos_objects.h"
#include "interpolated_motion_driver/emulation/error_store.h"
#include "interpolated_motion_driver/emulation/interpolated_position_mode.h"
#include "interpolated_motion_driver/emulation/motion_clock.h"
#include "interpolated_motion_driver/emulation/nmt_slave.h"
#include "interpolated_motion_driver/emulation/pdo_engine.h"
#include "interpolated_motion_driver/emulation/plant.h"
#include "interpolated_motion_driver/emulation/sdo_server.h"

namespace interpolated_motion::emulation {

// The parts of the drive put together. Three source files: power, clock and frames
// (epos_drive_implementation.cpp), objects and what writing them does (epos_drive_objects.cpp), the 1 ms
// sample (epos_drive_sample.cpp).
class EposDrive::Implementation : public SdoObjects, public PdoOwner {
 public:
  Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                 const EposParameters& parameters, HostTime now);

  const EposParameters& parameters() const { return parameters_; }
  EposCounters counters() const;
  void set_sample_observer(SampleObserver observer) { observer_ = std::move(observer); }
  Plant& plant() { return plant_; }
  const Plant& plant() const { return plant_; }

  void power_cycle(HostTime now, HostDuration off);
  void fault(std::uint16_t code, std::uint8_t error_register, HostTime now);
  void emergency(std::uint16_t code, std::uint8_t error_register, HostTime now);
  void silence(bool silent, HostTime now);
  void set_clock_error(double ppm);

  HostTime next_event() const;
  void process(HostTime now);
  void on_frame(const canopen::Frame& frame, HostTime time);

  AbortCode sdo_read(std::uint16_t index, std::uint8_t subindex, std::array<std::uint8_t, kSdoCapacity>& data,
                     std::size_t& size) override;
  AbortCode sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) override;
  AbortCode sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                      std::size_t size) override;
  void pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) override;
  void pdo_too_short() override;
  bool pdo_send(const canopen::Frame& frame) override;

 private:
  enum class Power { Off, Booting, On };

  struct Response {
    HostTime due{};
    canopen::Frame frame;
  };

  // epos_drive_implementation.cpp
  void power_up(HostTime now);
  void finish_boot(HostTime now);
  void update_connection(HostTime now);
  bool transmit(const canopen::Frame& frame);
  void send_state(std::uint8_t state);
  void send_emergency_bytes(const EmergencyBytes& bytes);
  void on_sync(HostTime time);
  void enter_operational();
  void on_nmt(const canopen::Frame& frame);
  void reset_communication();
  void on_sdo(const canopen::Frame& frame);
  void respond(const SdoServer::Bytes& bytes);
  void on_error_control(const canopen::Frame& frame);
  bool sdo_allowed() const;

  // epos_drive_objects.cpp
  AbortCode write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw);
  AbortCode check_value(ObjectDictionary::Slot slot, std::int64_t value) const;
  void written(ObjectDictionary::Slot slot);
  void communication_written(std::uint16_t index, std::uint8_t subindex);
  AbortCode take_record(std::uint64_t raw);
  RecordPolicy record_policy() const;
  void controlword(std::uint16_t word);
  void select_mode(int mode);
  void command_interpolation(bool enabled, bool was_enabled);
  void stop_interpolation();
  void apply_communication_parameters();
  void update_limits();
  void load_stored(bool communication_only);
  void store_parameters() { stored_ = objects_.values(); }
  void restore_cob_ids();
  OptionCodes option_codes() const;
  std::uint16_t statusword() const;
  void publish_status();
  void publish_errors();
  int mode() const;

  // epos_drive_sample.cpp
  void sample();
  void watch_connections();
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
  void pump_segments();

  const EposParameters parameters_;
  transport::VirtualCanBus& bus_;
  int port_;
  HostTime now_;

  Power power_ = Power::Off;
  HostTime power_event_;
  bool silent_ = false;
  MotionClock clock_;
  std::int64_t milliseconds_ = 0;

  EposObjects objects_;
  std::optional<ObjectDictionary::Values> stored_;
  SdoServer sdo_;
  NmtSlave nmt_;
  PdoEngine pdo_;
  DeviceControl device_;
  ErrorStore errors_;
  InterpolatedPositionMode ip_;
  Plant plant_;
  std::deque<Response> responses_;

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
