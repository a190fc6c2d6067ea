#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// One sample of an emulated drive's interpolator, whatever its kind. Nothing of it travels over the wire.
struct DemandSample {
  HostTime time{};
  double drive_seconds = 0.0;  ///< on the drive's own clock, from the start of its motion
  double demand = 0.0;         ///< counts, before rounding
  std::int32_t actual = 0;     ///< counts
};

/// Told about each sample of a joint's drive while it interpolates.
using SampleObserver = std::function<void(std::size_t joint, const DemandSample&)>;

}  // namespace interpolated_motion::hardware
