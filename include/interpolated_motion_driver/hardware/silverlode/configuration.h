#pragma once

#include <memory>
#include <string>

#include "interpolated_motion_driver/axis/silverlode/segment_registers.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::hardware {

/// What only drives of type `silverlode_ims` have.
struct SilverlodeSettings : DriveSettings {
  /// counts, DriveConfiguration::deviation_bound where the path is still being made
  double stream_deviation_bound = 8.0;
  interpolation::ImsScale scale;                        ///< of segments
  silverlode::DriveScale command_scale;                 ///< of all other commands, and of register 19
  std::string ims_arguments = "0 0";                    ///< of IMS
  axis::SegmentQueue queue = axis::SegmentQueue::Fifo;  ///< where segments wait in the drive
  int queue_depth = 0;                                  ///< segments of the FIFO; 0: measured at bring-up
  axis::SegmentRegisters segment_registers;             ///< where `queue` is Registers
  bool target_in_motion = true;              ///< register 0 tells the demand in an interpolated motion too
  emulation::SilverDustParameters emulated;  ///< what the emulated drive is; agrees with the settings above
};

/// Reads it. `drive` holds what all drives have. Throws like ParameterReader.
std::shared_ptr<const SilverlodeSettings> parse_silverlode(ParameterReader& reader,
                                                           ParameterReader& emulation,
                                                           const DriveConfiguration& drive);

/// One command starts all drives of a line with `start: global`: it has one set of arguments. Throws
/// std::invalid_argument where `drive` has others than the first one of its line.
void check_common_start(const DriveConfiguration& drive, const Configuration& all);

}  // namespace interpolated_motion::hardware
