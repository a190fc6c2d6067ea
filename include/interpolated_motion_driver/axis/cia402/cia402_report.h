#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/cia402/statusword.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What every CiA 402 drive tells of itself.
struct Cia402Report {
  cia402::Statusword statusword;  ///< 0x6041; 0 until the first has arrived
  std::int8_t mode = 0;           ///< 0x6061
  cia402::State state() const { return statusword.state(); }
  HostTime status_time{};  ///< when the statusword arrived; the epoch: none yet
};

}  // namespace interpolated_motion::axis
