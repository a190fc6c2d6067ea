#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/axis/axis_parameters.h"
#include "interpolated_motion_driver/axis/silverlode/segment_registers.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

/// Settings of one SilverLode drive.
struct SilverlodeAxisParameters : AxisParameters {
  double deviation_bound = 2.0;           ///< counts, at any servo tick
  double stream_deviation_bound = 500.0;  ///< counts, up to which it may be doubled in a stream of setpoints
  double limit_margin = 1.2;    ///< segments may exceed the joint's acceleration by this factor between knots
  double commit_horizon = 0.5;  ///< s of motion kept in the drive's queue
  double stream_horizon = 0.1;  ///< the same, while setpoints are followed
  double line_share = 0.85;     ///< of the line's time that segments may fill, above 0 to 1
  double start_lead = 0.3;      ///< s from arm() to the begin of the path

  interpolation::ImsScale scale;  ///< of the segments; its counts per revolution are those of `transmission`
  silverlode::DriveScale command_scale;     ///< of all other commands
  std::string ims_arguments = "0 0";        ///< of IMS: in no document at hand
  SegmentQueue queue = SegmentQueue::Fifo;  ///< where segments wait: decides which of the next two matters
  int queue_depth = 0;  ///< of the FIFO: 4, or 8 from SilverDust revision 06 on; 0: measured at bring-up
  SegmentRegisters segment_registers;  ///< of the register-based queue
  /// Register 0 is the demand at each servo tick of an interpolated motion, not only after it.
  bool target_in_motion = true;
  double max_clock_error = 5e-4;  ///< of the drive's crystal, relative

  /// From the last bit of a command to its execution by the drive, at most. Nothing is documented; the reply
  /// follows about 2 ms after the command, the command is executed before.
  HostDuration execution_time = std::chrono::microseconds(300);
  HostDuration status_period = std::chrono::milliseconds(50);  ///< between two looks at the drive in motion
  HostDuration feedback_timeout =
      std::chrono::milliseconds(1000);  ///< longest silence of position reports in motion
};

}  // namespace interpolated_motion::axis
