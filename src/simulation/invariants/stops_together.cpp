#include "simulation/invariants/stops_together.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GroupState;

namespace {

/// s: SYNC or a round of a serial line until the drives have the order, and the lag of the servo.
constexpr double kNotice = 0.4;
/// s: what a host that has died was watched by (heartbeat_timeout at most 1), or a queue until it runs dry.
constexpr double kWatch = 1.5;
constexpr double kInterval = 0.02;  // s, over which a joint counts as moving
constexpr double kCounts = 5.0;     ///< within that time
constexpr double kRecovery = 3.0;   // s for which a fault excuses the joint itself

}  // namespace

bool StopsTogether::is_due(HostTime now) const {
  double braking = 0.0;
  for (const Joint& joint : arm().joints)
    braking = std::max(braking, joint.max_velocity / joint.max_acceleration);
  double allowed = braking + kNotice;
  if (ledger().is_dead()) allowed += kWatch + arm().commit_horizon;
  if (ledger().last_absence() > stopping_since_)
    allowed = std::max(allowed, seconds(ledger().last_absence() - stopping_since_) + allowed);
  return seconds(now - stopping_since_) > allowed;
}

bool StopsTogether::is_excused(std::size_t joint, HostTime now) const {
  return ledger().is_touched(joint, now, kRecovery + arm().commit_horizon);
}

void StopsTogether::look(const Look& look) {
  const GroupState state = ledger().state();
  const bool stops = state == GroupState::Stopping || state == GroupState::Fault || ledger().is_dead();
  if (!stops) {
    stopping_since_ = kNever;
    return;
  }
  if (stopping_since_ == kNever) {
    stopping_since_ = look.now;
    mark_ = {look.now, *look.positions};
  }
  if (seconds(look.now - mark_.time) < kInterval) return;
  const double stretch = seconds(look.now - mark_.time) / kInterval;
  for (std::size_t i = 0; i < look.positions->size() && is_due(look.now); ++i) {
    const Joint& joint = arm().joints[i];
    const double moved = std::abs((*look.positions)[i] - mark_.positions[i]) / joint.count();
    if (moved <= kCounts * stretch || is_excused(i, look.now)) continue;
    fail(fmt::format("{} still moves ({:.0f} counts in {:.0f} ms) {:.2f} s after the group has {}",
                     joint.label(), moved, 1e3 * seconds(look.now - mark_.time),
                     seconds(look.now - stopping_since_),
                     ledger().is_dead() ? "lost its host" : "begun to stop"));
  }
  mark_ = {look.now, *look.positions};
}

}  // namespace interpolated_motion::simulation
