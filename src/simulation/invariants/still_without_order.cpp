#include "simulation/invariants/still_without_order.h"

#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GroupState;

namespace {

/// s: a servo lags behind its demand, and drives that are out of reach of the host stop by themselves.
constexpr double kSettling = 0.3;
/// s after a fault of the joint: a blocked axis that is let go moves to where it should be, one without power
/// is where it is when power comes back.
constexpr double kRecovery = 3.0;
constexpr double kCounts = 3.0;  ///< a servo at rest may toggle by one, and one is lost by rounding

}  // namespace

void StillWithoutOrder::look(const Look& look) {
  if (!is_at_rest(ledger().state())) {
    rest_since_ = kNever;
    return;
  }
  if (rest_since_ == kNever) rest_since_ = look.now;
  const double settling = kSettling + (ledger().is_disturbed() ? arm().commit_horizon + kRecovery : 0.0);
  if (seconds(look.now - rest_since_) < settling || rest_.size() != look.positions->size()) {
    rest_ = *look.positions;
    return;
  }
  // The drives still play the end of their course, within its bound.
  const bool is_standing = ledger().state() == GroupState::Standing;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const Joint& joint = arm().joints[i];
    const double moved = ((*look.positions)[i] - rest_[i]) / joint.count();
    if (ledger().is_touched(i, look.now, kRecovery)) {
      rest_[i] = (*look.positions)[i];
    } else if (std::abs(moved) > kCounts + (is_standing ? joint.joining_bound : 0.0)) {
      fail(fmt::format("{} has moved by {:.0f} counts while the group is {}", joint.label(), moved,
                       motion::to_string(ledger().state())));
    }
  }
}

void StillWithoutOrder::state_change(HostTime) {
  const GroupState state = ledger().state();
  const GroupState former = ledger().former_state();
  if (former == GroupState::Standing) rest_since_ = kNever;  // the drives have landed where their records end
  const bool moves =
      state == GroupState::Preparing || state == GroupState::Moving || state == GroupState::Streaming;
  if (!moves || !is_at_rest(former)) return;
  if (!ledger().has_order_since(HostTime::min() + std::chrono::nanoseconds(1)))
    fail(fmt::format("the group is {} without an order", motion::to_string(state)));
  if (state != GroupState::Streaming && !ledger().has_open_goal())
    fail(fmt::format("the group is {} though no goal is open", motion::to_string(state)));
}

}  // namespace interpolated_motion::simulation
