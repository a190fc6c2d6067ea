#pragma once

#include "interpolated_motion_driver/axis/composed_axis.h"
#include "interpolated_motion_driver/axis/silverlode/ims_player.h"
#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/axis/silverlode/power_stage.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"

namespace interpolated_motion::axis {

/// A QuickSilver SilverLode drive in interpolated motion (IMS), fed over a serial line.
class SilverlodeAxis : public ComposedAxis {
 public:
  /// `common_start`: what starts the drives of the line together; null when each gets an IMS of its own. It,
  /// `line` and `device` must outlive the axis. Throws std::invalid_argument, naming joint and parameter.
  SilverlodeAxis(const SilverlodeAxisParameters& parameters, silverlode::LineMaster& line,
                 silverlode::DeviceLink& device, LineStart* common_start = nullptr);

 private:
  SilverlodePowerStage stage_;
  ImsPlayer player_;
};

}  // namespace interpolated_motion::axis
