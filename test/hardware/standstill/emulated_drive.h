#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::test {

struct StandstillParameters {
  int node_id = 1;            ///< 1..127
  std::int32_t position = 0;  ///< counts, where it stands
};

/// An emulated drive on CANopen that stands still: told to start (NMT), it answers each SYNC with its
/// position in TPDO1. Its command: `wedge COUNTS`, its position changes by so much, up to a million.
class StandstillDrive : public emulation::Drive, public transport::CanListener {
 public:
  /// Off and on are one: it is operational from the NMT command on. `bus` must outlive it.
  StandstillDrive(transport::VirtualCanBus& bus, const StandstillParameters& parameters, HostTime now);

  HostTime next_event() const override { return kNever; }
  void process(HostTime) override {}
  std::int32_t position() const override { return position_; }
  bool has_torque() const override { return operational_; }
  void observe(Observer observer) override { observer_ = std::move(observer); }
  void power_cycle(HostTime, HostDuration) override { operational_ = false; }
  void stall(bool) override {}
  void silence(bool silent, HostTime) override { silent_ = silent; }
  void set_clock_error(double) override {}
  void on_can_frame(const canopen::Frame& frame, HostTime time) override;

 private:
  std::vector<emulation::FaultCommand> own_faults(HostTime now) override;
  void report(HostTime time);

  transport::VirtualCanBus& bus_;
  int port_;
  int node_id_;
  std::int32_t position_;
  bool operational_ = false;
  bool silent_ = false;
  Observer observer_;
};

}  // namespace interpolated_motion::test
