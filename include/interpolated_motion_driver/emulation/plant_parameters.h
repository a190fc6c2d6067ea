#pragma once

namespace interpolated_motion::emulation {

/// The axis behind the drive: a position loop that follows the demand with a second-order lag.
struct PlantParameters {
  double lag_ms =
      2.0;  ///< ms, >= 0: following error at constant velocity divided by that velocity; 0: follows exactly
  double load_counts = 0.0;  ///< counts: standing deviation caused by an external load
};

}  // namespace interpolated_motion::emulation
