#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Nothing moves without an order: no joint while the group says that it rests, and the group begins to move
/// only when a goal or a setpoint was accepted.
class StillWithoutOrder : public Invariant {
 public:
  explicit StillWithoutOrder(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "still without an order"; }
  void look(const Look& look) override;
  void state_change(HostTime now) override;

 private:
  HostTime rest_since_ = kNever;
  std::vector<double> rest_;  ///< rad, where the joints came to rest
};

}  // namespace interpolated_motion::simulation
