#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "interpolated_motion_driver/emulation/canopen/error_store.h"
#include "interpolated_motion_driver/emulation/canopen/motion_clock.h"
#include "interpolated_motion_driver/emulation/canopen/nmt_slave.h"
#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/canopen/pdo_engine.h"
#include "interpolated_motion_driver/emulation/canopen/sdo_server.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// What every emulated CANopen node has, whatever it drives.
struct NodeSettings {
  std::uint8_t node_id = 1;
  std::string device_name;  ///< 0x1008
  MotionClockSettings clock;
  HostDuration sample_phase{};  ///< of the first sample after boot
  HostDuration boot_time = std::chrono::milliseconds(200);
  HostDuration sdo_response_time{};
  std::uint8_t communication_error_register = 0x10;  ///< bits added to 0x1001 with EMCY 0x8130 and 0x8210
  bool pre_operational_on_heartbeat_loss = false;
  bool pdo_setup_only_pre_operational = true;  ///< PDO parameters written in Operational are aborted
};

/// The CANopen side of an emulated drive (CiA 301): power and boot, own crystal, NMT, SDO, PDO, EMCY,
/// heartbeat and node guarding, and the objects 0x1000..0x1FFF. What the drive does beyond that, it does in
/// the functions a derived class has to give.
class CanopenNode : private SdoObjects, private PdoOwner {
 public:
  ~CanopenNode() override = default;
  CanopenNode(const CanopenNode&) = delete;
  CanopenNode& operator=(const CanopenNode&) = delete;

  void power_cycle(HostTime now, HostDuration off);
  void silence(bool silent, HostTime now);
  void set_clock_error(double ppm);
  /// Sends an EMCY message without any other reaction.
  void emergency(std::uint16_t code, std::uint8_t error_register, HostTime now);

  HostTime next_event() const;
  void process(HostTime now);
  void on_frame(const canopen::Frame& frame, HostTime time);

  std::uint64_t emergencies() const { return emergencies_; }
  std::uint64_t lost_frames() const { return lost_frames_; }

 protected:
  /// `objects` is of the derived class; it is not touched before the node has booted.
  CanopenNode(transport::VirtualCanBus& bus, transport::CanListener& listener, const NodeSettings& settings,
              ObjectDictionary& objects, HostTime now);

  /// What the objects are after power-up or a reset; of the latter NMT resets those below 0x2000 alone, if
  /// it is of the communication.
  virtual ObjectDictionary::Values initial_values() const { return objects_.defaults(); }
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
  /// Objects derived from the state are to be brought up to date.
  virtual void publish_status() = 0;
  /// Rules for writing an object that go beyond type and range and beyond what CiA 301 says of PDOs and
  /// errors.
  virtual AbortCode check_value(const ObjectEntry& entry, std::int64_t value) const = 0;
  /// A value that goes elsewhere than into its object: what becomes of it.
  virtual std::optional<AbortCode> divert(const ObjectEntry& /*entry*/, std::uint64_t /*raw*/) {
    return std::nullopt;
  }
  /// An object has been written that means nothing to the node itself.
  virtual void written(const ObjectEntry& entry, std::int64_t value) = 0;

  bool on() const { return power_ == Power::On; }
  HostTime now() const { return now_; }
  bool operational() const { return nmt_.operational(); }
  bool has_errors() const { return errors_.any(); }

  MotionClock& clock() { return clock_; }
  /// Now on the node's own clock, in samples since it booted.
  double own_time() const { return clock_.samples_at(now_); }

  /// Error reset: the EMCY message says so.
  void reset_errors();
  /// PDO parameters have been changed by other ways than writing them.
  void configure_pdos() { pdo_.configure(); }

 private:
  enum class Power { Off, Booting, On };

  struct Response {
    HostTime due{};
    canopen::Frame frame;
  };

  // canopen_node.cpp
  void power_up(HostTime now);
  void finish_boot(HostTime now);
  void update_connection(HostTime now);
  void run_sample();
  void watch_connections();
  std::int64_t milliseconds() const;
  bool transmit(const canopen::Frame& frame);
  void send_state(std::uint8_t state);
  void send_emergency_bytes(const EmergencyBytes& bytes);
  void on_sync(HostTime time);
  void on_nmt(const canopen::Frame& frame);
  void enter_operational();
  void on_sdo(const canopen::Frame& frame);
  void on_error_control(const canopen::Frame& frame);
  void respond(const SdoServer::Bytes& bytes);
  void pump_segments();
  bool sdo_allowed() const;

  // canopen_node_objects.cpp
  AbortCode sdo_read(std::uint16_t index, std::uint8_t subindex, std::array<std::uint8_t, kSdoCapacity>& data,
                     std::size_t& size) override;
  AbortCode sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) override;
  AbortCode sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                      std::size_t size) override;
  void pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) override;
  void pdo_too_short() override;
  bool pdo_send(const canopen::Frame& frame) override;
  AbortCode write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw);
  bool communication_written(const ObjectEntry& entry, std::int64_t value);
  void restore_communication();
  void apply_communication();
  void publish_errors();
  std::int64_t value(std::uint16_t index, std::uint8_t subindex) const;
  void set(std::uint16_t index, std::uint8_t subindex, std::int64_t value);

  const NodeSettings settings_;
  transport::VirtualCanBus& bus_;
  int port_;
  ObjectDictionary& objects_;
  HostTime now_;

  Power power_ = Power::Off;
  HostTime power_event_;
  bool silent_ = false;
  MotionClock clock_;

  SdoServer sdo_;
  NmtSlave nmt_;
  PdoEngine pdo_;
  ErrorStore errors_;
  std::deque<Response> responses_;
  std::uint64_t emergencies_ = 0;
  std::uint64_t lost_frames_ = 0;
};

}  // namespace interpolated_motion::emulation
