#pragma once

#include "interpolated_motion_driver/axis/cia402/power_stage.h"
#include "interpolated_motion_driver/axis/composed_axis.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_device.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/axis/cyclic/setpoint_player.h"

namespace interpolated_motion::axis {

/// A CiA 402 drive in the cyclic synchronous position mode (mode 8) on an isochronous CANopen bus.
class CyclicAxis : public ComposedAxis {
 public:
  /// `master`, which must be isochronous with the same period, and `node` must outlive the axis. Throws
  /// std::invalid_argument, naming joint, parameter, value and range.
  CyclicAxis(const CyclicAxisParameters& parameters, canopen::Master& master, canopen::NodeLink& node);

  void poll(HostTime now) override;
  HostTime next_deadline() const override;

 private:
  CyclicDevice drive_;
  Cia402PowerStage stage_;
  SetpointPlayer player_;
};

}  // namespace interpolated_motion::axis
