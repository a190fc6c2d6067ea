#pragma once

#include <cstddef>
#include <functional>

#include "interpolated_motion_driver/emulation/drive.h"

namespace interpolated_motion::hardware {

using emulation::DemandSample;

/// Told about each sample of a joint's drive while it interpolates.
using SampleObserver = std::function<void(std::size_t joint, const DemandSample&)>;

}  // namespace interpolated_motion::hardware
