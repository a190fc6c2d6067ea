#pragma once

#include "interpolated_motion_driver/axis/cia402/power_stage.h"
#include "interpolated_motion_driver/axis/composed_axis.h"
#include "interpolated_motion_driver/axis/epos/epos_device.h"
#include "interpolated_motion_driver/axis/epos/epos_parameters.h"
#include "interpolated_motion_driver/axis/epos/pvt_player.h"

namespace interpolated_motion::axis {

/// A maxon EPOS drive in Interpolated Position Mode (mode 7) on CANopen.
class EposAxis : public ComposedAxis {
 public:
  /// `master` and `node` must outlive the axis. Throws std::invalid_argument, naming joint and parameter,
  /// when a limit is not finite.
  EposAxis(const EposAxisParameters& parameters, canopen::Master& master, canopen::NodeLink& node);

 private:
  EposDevice drive_;
  Cia402PowerStage stage_;
  PvtPlayer player_;
};

}  // namespace interpolated_motion::axis
