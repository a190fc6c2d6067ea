#include "interpolated_motion_driver/encoding/ims/acceleration_funnel.h"

#include <algorithm>

namespace interpolated_motion::encoding {

namespace {

/// Gates over the length expected. Twice as far the stride doubles, so any length has about as many.
constexpr std::int64_t kGatesPerLength = 16;

/// Fewer gates than this are too coarse: the length found is much less than expected.
constexpr std::size_t kFewGates = 6;

}  // namespace

/// The state in counts and ticks, and what limits the acceleration.
struct AccelerationFunnel::Motion {
  Motion(const ImsRules& rules, double bound_counts, std::int64_t at, const interpolation::ImsState& state)
      : tick(at), bound(bound_counts), moved(1.0 - 2.0 * rules.lag) {
    const double unit = rules.counts_per_unit;
    velocity = static_cast<double>(state.velocity) * unit;
    position = (static_cast<double>(state.sum) - rules.lag * static_cast<double>(state.velocity)) * unit;
    const double limit = static_cast<double>(rules.max_velocity) * unit;
    least_change = (state.velocity > 0 ? 0.0 : -limit) - velocity;
    greatest_change = (state.velocity < 0 ? 0.0 : limit) - velocity;
    max_acceleration = static_cast<double>(rules.max_step) * unit;
  }

  /// Narrows `gate` by what tick `t` after the state allows, where the path is at `path` counts.
  void narrow(double t, double path, Gate& gate) const {
    const double per_count = 2.0 / (t * (t + moved));
    const double per_change = 0.5 * per_count * (t + moved);
    const double missing = path - position - velocity * t;
    gate.low = std::max({gate.low, (missing - bound) * per_count, least_change * per_change});
    gate.high = std::min({gate.high, (missing + bound) * per_count, greatest_change * per_change});
  }

  std::int64_t tick;
  double bound;
  double moved;  ///< an acceleration a moves the position by a t (t + moved) / 2 in t ticks
  double position = 0.0;
  double velocity = 0.0;
  double least_change = 0.0;  ///< of the velocity
  double greatest_change = 0.0;
  double max_acceleration = 0.0;
};

void AccelerationFunnel::open(const ImsRules& rules, TickSamples& samples, double bound, std::int64_t tick,
                              const interpolation::ImsState& state, std::int64_t longest) {
  const Motion motion(rules, bound, tick, state);
  const double expected = std::min(guess_, static_cast<double>(longest));
  auto stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(expected) / kGatesPerLength);
  pass(motion, samples, stride, longest);
  while (size_ == kMaxGates) {  // and still open
    stride *= 4;
    pass(motion, samples, stride, longest);
  }
  while (size_ < kFewGates && stride > 1) {
    stride = std::max<std::int64_t>(1, stride / 4);
    pass(motion, samples, stride, longest);
  }
  guess_ = std::max(1.0, reach_);
}

void AccelerationFunnel::pass(const Motion& motion, TickSamples& samples, std::int64_t stride,
                              std::int64_t longest) {
  Gate gate{0, -motion.max_acceleration, motion.max_acceleration};
  size_ = 0;
  reach_ = 0.0;
  for (std::int64_t ticks = std::min(stride, longest); size_ < kMaxGates;) {
    samples.extend_to(motion.tick + ticks);
    const double width = gate.high - gate.low;
    motion.narrow(static_cast<double>(ticks), *samples.counts_from(motion.tick + ticks), gate);
    const double next_width = gate.high - gate.low;
    const auto step = static_cast<double>(ticks - gate.ticks);
    if (!(next_width >= 0.0)) {
      if (size_ > 0) reach_ += step * width / (width - next_width);
      return;
    }
    gate.ticks = ticks;
    gates_[size_++] = gate;
    reach_ = static_cast<double>(ticks);
    if (ticks == longest) return;
    if (size_ % (2 * kGatesPerLength) == 0) stride *= 2;
    ticks = std::min(longest, ticks + stride);
  }
}

}  // namespace interpolated_motion::encoding
