#pragma once

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/epos/epos_parameters.h"

namespace interpolated_motion::axis {

/// Sets the drive's watch over the host (0x1016:1) to what it is in motion, before anything is in the FIFO.
/// The drive begins to watch with the host's next heartbeat (CiA 301, 7.5.2.18).
SdoSequence::Step watch_host_in_motion(const EposAxisParameters& parameters);
/// The same at rest: a drive that stands goes on standing without its host, which need not be there.
SdoSequence::Step watch_host_at_rest(const EposAxisParameters& parameters);

}  // namespace interpolated_motion::axis
