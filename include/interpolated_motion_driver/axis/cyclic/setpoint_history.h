#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/cip_polynomial.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The newest target positions of a drive and the instants at which they are reached, as many as its fine
/// interpolation takes; and where the drive goes on to beyond the newest while no further one comes
/// ("Behavior models used in CIP Motion", Fine Command Interpolation: the polynomial extrapolates).
class SetpointHistory {
 public:
  /// `order`: of the drive's fine interpolation, 1..3. `period`, > 0: between target positions that come in
  /// time.
  SetpointHistory(int order, HostDuration period) : order_(order), period_(period) {}

  /// A target position in counts, reached at `stamp`, later than the one before. The first one after
  /// `clear()` has been the drive's for ever.
  void add(HostTime stamp, std::int32_t counts);
  void clear() { known_ = false; }

  /// Instant of the newest; HostTime{} before the first.
  HostTime newest() const { return known_ ? targets_[0].stamp : HostTime{}; }

  /// The drive's demand at `when`, not before the newest target position but one: position, velocity and
  /// acceleration in the joint's units. Before the first target position: zeros.
  trajectory::State at(HostTime when, const encoding::Transmission& transmission) const;

 private:
  struct Target {
    HostTime stamp{};
    std::int32_t counts = 0;
  };

  int order_;
  HostDuration period_;
  bool known_ = false;
  std::array<Target, interpolation::kCipHistory> targets_{};  // the newest first
};

}  // namespace interpolated_motion::axis
