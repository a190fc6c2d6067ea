#include "simulation/invariants/fault_holds.h"

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GroupState;

void FaultHolds::state_change(HostTime now) {
  const GroupState state = ledger().state();
  if (ledger().former_state() == GroupState::Fault && !ledger().has_request_since("reset", faulted_))
    fail(fmt::format("the group has left its fault for {} without a reset", motion::to_string(state)));
  if (state == GroupState::Fault) faulted_ = now;
  if (state == GroupState::Fault || state == GroupState::Disabled) disabled_since_ = now;
  const bool enables = state == GroupState::Enabling || state == GroupState::Idle;
  const bool was_off =
      ledger().former_state() == GroupState::Disabled || ledger().former_state() == GroupState::Starting;
  const bool at_start = arm().enable_on_start && faulted_ == kNever && !was_enabled_;
  if (enables && was_off && !at_start && !ledger().has_request_since("enable", disabled_since_))
    fail(fmt::format("the group is {} though nobody has asked for power", motion::to_string(state)));
  if (state == GroupState::Idle) was_enabled_ = true;
}

}  // namespace interpolated_motion::simulation
