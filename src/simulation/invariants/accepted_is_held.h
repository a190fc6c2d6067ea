#pragma once

#include <string>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Where nothing went wrong from outside, what was accepted is held: goals succeed unless another order ends
/// them, and reach their last point; the group has no fault; requests succeed.
class AcceptedIsHeld : public Invariant {
 public:
  explicit AcceptedIsHeld(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "accepted is held"; }
  void look(const Look& look) override;
  void goal_ended(const GoalEntry& goal) override;

 private:
  void check_outcome(const GoalEntry& goal);

  GoalEntry ended_;  ///< the goal whose end has to be looked at
  bool look_at_end_ = false;
};

}  // namespace interpolated_motion::simulation
