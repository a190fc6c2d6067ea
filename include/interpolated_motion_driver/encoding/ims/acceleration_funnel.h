#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/encoding/ims/ims_move.h"
#include "interpolated_motion_driver/encoding/ims/tick_samples.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"

namespace interpolated_motion::encoding {

/// The constant accelerations that keep a motion from a given state within the bound of the path and within
/// its limits. Each tick allows an interval of accelerations, so up to a tick the intersection of these is
/// allowed: a funnel that narrows, and ends where nothing is left. The velocity must not change its sign.
///
/// Tests some ticks only, evenly spread over the length found last time: a necessary condition, quick to
/// evaluate. Whether a segment keeps its rules is decided by execute().
class AccelerationFunnel {
 public:
  /// Accelerations allowed up to some tick, counts/tick^2.
  struct Gate {
    std::int64_t ticks = 0;  ///< after the state
    double low = 0.0;        ///< least and
    double high = 0.0;       ///< greatest acceleration allowed
  };

  /// Looks ahead from `state` at `tick` for up to `longest` (>= 1) ticks. `bound` (counts) applies instead of
  /// rules.bound: a little less, as the worst tick may lie between those tested.
  void open(const ImsRules& rules, TickSamples& samples, double bound, std::int64_t tick,
            const interpolation::ImsState& state, std::int64_t longest);

  /// Gates that are open, in order of time.
  std::size_t size() const { return size_; }
  const Gate& operator[](std::size_t i) const { return gates_[i]; }

  /// Ticks after which the funnel closes, between the last open gate and the next; `longest` if it does not.
  double reach() const { return reach_; }

 private:
  static constexpr std::size_t kMaxGates = 96;
  struct Motion;

  void pass(const Motion& motion, TickSamples& samples, std::int64_t stride, std::int64_t longest);

  std::array<Gate, kMaxGates> gates_;
  std::size_t size_ = 0;
  double reach_ = 0.0;
  double guess_ = 512.0;  ///< ticks, reach of the time before
};

}  // namespace interpolated_motion::encoding
