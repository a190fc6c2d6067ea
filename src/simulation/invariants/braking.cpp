#include "simulation/invariants/braking.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

constexpr double kInterval = 0.0299;  // s, between looks that are compared
constexpr double kGap = 0.0451;       // s
/// Counts: positions are whole counts, and an acceleration is made of three of them.
constexpr double kRounding = 2.5;
/// A servo with its lag overshoots the step of an acceleration.
constexpr double kOvershoot = 1.15;
constexpr double kRecovery = 3.0;  // s, for which a fault excuses the joint

}  // namespace

void Braking::check(std::size_t index, double position, HostTime now) {
  Track& track = tracks_[index];
  const double step = seconds(now - track.time);
  if (track.known == 0 || step > kGap) {
    track = {now, position, 0.0, 0.0, 1};
    return;
  }
  if (step < kInterval) return;
  const Track next{now, position, step, (position - track.position) / step, 2};
  const Joint& joint = arm().joints[index];
  const double acceleration = (next.velocity - track.velocity) / (0.5 * (step + track.step));
  // A look comes before or after a sample of the drive as their clocks happen to lie.
  const double jitter = std::max(std::abs(next.velocity), std::abs(track.velocity)) * joint.sample_period;
  const double most = kOvershoot * joint.limit_margin * joint.max_acceleration +
                      (kRounding * joint.count() + jitter) / (step * step);
  const bool excused = ledger().is_touched(index, now, kRecovery);
  if (track.known == 2 && !excused && std::abs(acceleration) > most) {
    fail(fmt::format("{}: accelerates by {:.2f} rad/s^2 while the group is {}, allowed {:.2f} (limit {})",
                     joint.label(), acceleration, motion::to_string(ledger().state()), most,
                     joint.max_acceleration));
  }
  track = next;
}

void Braking::look(const Look& look) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) check(i, (*look.positions)[i], look.now);
}

}  // namespace interpolated_motion::simulation
