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
  /// The drive has not taken those of the SYNCs that were due from `first` to `last`, a period before their
  /// stamps. Returns how many there were.
  std::size_t drop(HostTime first, HostTime last);

  /// Instant of the newest; HostTime{} before the first.
  HostTime newest() const { return known_ ? targets_[0].stamp : HostTime{}; }
  /// Instant from which on the drive has been told what it interpolates through now; HostTime{} before the
  /// first.
  HostTime oldest_in_use() const {
    return known_ ? targets_[static_cast<std::size_t>(order_)].stamp : HostTime{};
  }
  /// What the drive interpolates through, in the joint's units, with times in s after `origin`. At least one
  /// must be known.
  interpolation::CipKnots knots(HostTime origin, const encoding::Transmission& transmission) const;

  /// The drive's demand at `when`, not before the newest target position but one: position, velocity and
  /// acceleration in the joint's units. Before the first target position: zeros.
  trajectory::State at(HostTime when, const encoding::Transmission& transmission) const;

 private:
  struct Target {
    HostTime stamp{};
    std::int32_t counts = 0;
  };
  /// Some behind those that the drive uses, for it goes on with these when newer ones are dropped.
  static constexpr std::size_t kKept = 2 * interpolation::kCipHistory;

  /// From number `from` on, takes for the targets what the one before has been for ever.
  void rest_before(std::size_t from);

  int order_;
  HostDuration period_;
  bool known_ = false;
  std::array<Target, kKept> targets_{};  // the newest first
};

}  // namespace interpolated_motion::axis
