#include "simulation/invariants/published_is_true.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GroupState;

namespace {

/// s of rest after which the last position has come from every drive: a serial line at rest is asked twice a
/// second.
constexpr double kRest = 1.5;
constexpr double kCounts = 2.0;    ///< between a position in whole counts and one that was rounded once more
constexpr double kRecovery = 4.0;  // s for which a fault excuses the joint
/// s by which a published instant may be older than the look: two SYNC periods of at most 20 ms, and waiting
/// frames.
constexpr double kAge = 0.06;

}  // namespace

void PublishedIsTrue::check_joint(std::size_t index, const motion::JointSnapshot& published,
                                  const Look& look) {
  const Joint& joint = arm().joints[index];
  if (published.fill > published.capacity)
    fail(fmt::format("{}: {} records in a FIFO of {}", joint.label(), published.fill, published.capacity));
  if (!published.online || rest_since_ == kNever || seconds(look.now - rest_since_) < kRest) return;
  if (ledger().is_touched(index, look.now, kRecovery)) return;
  const double off = (published.actual.position - (*look.positions)[index]) / joint.count();
  if (std::abs(off) > kCounts)
    fail(fmt::format("{} is published {:.1f} counts beside where it stands, group {}", joint.label(), off,
                     motion::to_string(look.snapshot->state)));
}

bool PublishedIsTrue::rests(const Look& look) {
  // While drives are being found, their positions are yet to come.
  if (!is_at_rest(look.snapshot->state) || look.snapshot->state == GroupState::Starting) return false;
  if (rest_since_ == kNever || rest_.size() != look.positions->size()) return false;
  for (std::size_t i = 0; i < rest_.size(); ++i)
    if (std::abs(rest_[i] - (*look.positions)[i]) > 1.5 * arm().joints[i].count()) return false;
  return true;
}

void PublishedIsTrue::look(const Look& look) {
  if (!look.is_host_there) {
    rest_since_ = kNever;
    return;
  }
  const motion::Snapshot& snapshot = *look.snapshot;
  if ((snapshot.state == GroupState::Fault) == snapshot.fault.empty())
    fail(fmt::format("state {} with the fault text \"{}\"", motion::to_string(snapshot.state),
                     snapshot.fault));
  const bool has_goal = snapshot.state == GroupState::Preparing || snapshot.state == GroupState::Moving ||
                        snapshot.state == GroupState::Settling;
  const bool is_paused = snapshot.state == GroupState::Idle && ledger().is_slowed_down();
  const bool may_have = has_goal || is_paused || snapshot.state == GroupState::Stopping;
  if ((has_goal && snapshot.active_goal == 0) || (!may_have && snapshot.active_goal != 0))
    fail(
        fmt::format("state {} with active goal {}", motion::to_string(snapshot.state), snapshot.active_goal));
  if (!rests(look)) {
    rest_since_ = look.now;
    rest_ = *look.positions;
  }
  for (std::size_t i = 0; i < snapshot.joints.size(); ++i) check_joint(i, snapshot.joints[i], look);
}

bool DesiredIsSmooth::is_as_before(const motion::Snapshot& snapshot) const {
  return std::equal(
      desired_.begin(), desired_.end(), snapshot.joints.begin(), snapshot.joints.end(),
      [](double before, const motion::JointSnapshot& joint) { return before == joint.desired.position; });
}

void DesiredIsSmooth::look(const Look& look) {
  if (!look.is_host_there) {
    was_away_ = true;
    return;
  }
  const motion::Snapshot& snapshot = *look.snapshot;
  const bool known =
      desired_.size() == snapshot.joints.size() && !is_at_rest(state_) && !is_at_rest(snapshot.state);
  const double step = seconds(look.now - time_) + kAge;
  for (std::size_t i = 0; known && !ledger().is_disturbed() && i < desired_.size(); ++i) {
    const Joint& joint = arm().joints[i];
    const double jump = snapshot.joints[i].desired.position - desired_[i];
    // Positions of a serial line come when there is time for them.
    if (joint.kind == "silverlode_ims" || std::abs(jump) <= joint.max_velocity * step) continue;
    fail(fmt::format("{}: the desired position jumps by {:.4f} rad as the group goes from {} to {}",
                     joint.label(), jump, motion::to_string(state_), motion::to_string(snapshot.state)));
  }
  // An order may be carried out before the first reports are read that have come meanwhile: then another
  // state is published, and of the old reports what belongs to it. Drives that brake tell where they are a
  // while later.
  const bool has_read = seconds(look.now - ledger().last_absence()) > kAge;
  was_away_ = was_away_ && (!has_read || is_as_before(snapshot));
  if (!was_away_) time_ = look.now;
  desired_.resize(snapshot.joints.size());
  for (std::size_t i = 0; i < desired_.size(); ++i) desired_[i] = snapshot.joints[i].desired.position;
  state_ = snapshot.state;
}

}  // namespace interpolated_motion::simulation
