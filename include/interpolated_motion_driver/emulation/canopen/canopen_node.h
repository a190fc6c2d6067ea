#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/emulation/canopen/communication_objects.h"
#include "interpolated_motion_driver/emulation/canopen/emergency_producer.h"
#include "interpolated_motion_driver/emulation/canopen/motion_clock.h"
#include "interpolated_motion_driver/emulation/canopen/nmt_slave.h"
#include "interpolated_motion_driver/emulation/canopen/node_port.h"
#include "interpolated_motion_driver/emulation/canopen/object_access.h"
#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/canopen/pdo_engine.h"
#include "interpolated_motion_driver/emulation/canopen/sdo_channel.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// What every emulated CANopen node has, whatever it drives.
struct NodeSettings {
  std::uint8_t node_id = 1;     ///< 1..127
  std::string device_name;      ///< 0x1008
  MotionClockSettings clock;    ///< of its crystal, and how it follows the master's
  HostDuration sample_phase{};  ///< of the first sample after boot
  /// From power-up to the boot-up message; deaf and silent until then.
  HostDuration boot_time = std::chrono::milliseconds(200);
  HostDuration sdo_response_time{};                  ///< from a request to its response, >= 0
  std::uint8_t communication_error_register = 0x10;  ///< bits added to 0x1001 with EMCY 0x8130 and 0x8210
  /// Leaves Operational when the heartbeat of a watched node or life guarding fails.
  bool pre_operational_on_heartbeat_loss = false;
  bool pdo_setup_only_pre_operational = true;  ///< PDO parameters written in Operational are aborted
};

/// The CANopen side of an emulated drive (CiA 301): power and boot, own crystal, NMT, SDO, PDO, EMCY,
/// heartbeat and node guarding, and the objects 0x1000..0x1FFF. What the drive does beyond that, it does in
/// the functions a derived class has to give, those of ObjectOwner included.
class CanopenNode : private ObjectOwner, private PdoOwner {
 public:
  ~CanopenNode() override = default;
  CanopenNode(const CanopenNode&) = delete;
  CanopenNode& operator=(const CanopenNode&) = delete;

  /// Switches the supply off at `now`, and on again after `off`.
  void power_cycle(HostTime now, HostDuration off);

  /// While silent the node neither hears nor says anything, but goes on moving.
  void silence(bool silent, HostTime now) { port_.set_silent(silent, now); }

  /// The crystal's error from the next sample on, ppm; > 0: fast.
  void set_clock_error(double ppm) { clock_.set_error(ppm); }

  /// Sends an EMCY message without any other reaction; nothing while the node has not booted.
  void emergency(std::uint16_t code, std::uint8_t error_register, HostTime now);

  /// Time of the next thing the node does by itself.
  HostTime next_event() const;

  /// Does everything that is due at `now`.
  void process(HostTime now);

  /// A frame on the bus, whose last bit was at `time`.
  void on_frame(const canopen::Frame& frame, HostTime time);

  /// EMCY messages there have been, and frames that were lost because the transmit queue was full.
  std::uint64_t emergencies() const { return emergencies_.raised(); }
  std::uint64_t lost_frames() const { return port_.lost(); }

 protected:
  /// `objects` is of the derived class; it is not touched before the node has booted.
  CanopenNode(transport::VirtualCanBus& bus, transport::CanListener& listener, const NodeSettings& settings,
              ObjectDictionary& objects, HostTime now);

  /// The defaults of the objects, unless a derived class stores others.
  ObjectDictionary::Values initial_values() const override { return objects_.defaults(); }
  /// Booted: every volatile state begins anew. The objects have their initial values.
  virtual void booted() = 0;
  /// The supply has been switched off.
  virtual void powered_off() = 0;
  /// One sample of the own clock, before anything is sent.
  virtual void sample() = 0;
  /// The heartbeat of a watched node, or node guarding, has failed; the EMCY message has been sent.
  virtual void connection_lost() = 0;
  /// A heartbeat of a watched node has come.
  virtual void heartbeat_heard() {}

  /// Powered and booted.
  bool on() const { return power_ == Power::On; }

  /// Time of what is being done.
  HostTime now() const { return now_; }

  /// NMT state.
  bool operational() const { return nmt_.operational(); }

  MotionClock& clock() { return clock_; }
  /// Now on the node's own clock, in samples since it booted.
  double own_time() const { return clock_.samples_at(now_); }

  /// Error reset: the EMCY message says so.
  void reset_errors() { emergencies_.reset(now_); }
  /// PDO parameters have been changed by other ways than writing them.
  void configure_pdos() { pdo_.configure(); }

 private:
  enum class Power { Off, Booting, On };

  void power_up(HostTime now);
  void finish_boot(HostTime now);
  void boot_nmt();
  void run_sample();
  void watch_connections();
  void send_state(std::uint8_t state);
  void on_nmt(const canopen::Frame& frame);
  void entered_state();
  void reset_communication();
  void on_pdo(const canopen::Frame& frame);
  void on_error_control(const canopen::Frame& frame);

  void pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) override { access_.pdo_write(slot, raw); }
  void pdo_too_short() override;
  bool pdo_send(const canopen::Frame& frame) override { return port_.send(frame, now_); }

  const NodeSettings settings_;
  ObjectDictionary& objects_;
  HostTime now_;
  Power power_ = Power::Off;
  HostTime power_event_;

  NodePort port_;
  MotionClock clock_;
  NmtSlave nmt_;
  EmergencyProducer emergencies_;
  PdoEngine pdo_;
  CommunicationObjects communication_;
  ObjectAccess access_;
  SdoChannel sdo_;
};

}  // namespace interpolated_motion::emulation
