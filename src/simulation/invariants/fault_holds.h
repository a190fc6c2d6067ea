#pragma once

#include <string>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// After a fault nothing happens before reset, enable and a new order: the group leaves Fault only by a
/// reset, Disabled only by an enable, and a goal from before the fault is over.
class FaultHolds : public Invariant {
 public:
  explicit FaultHolds(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "a fault holds"; }
  void state_change(HostTime now) override;

 private:
  HostTime faulted_ = kNever;  ///< since when no reset has been asked for
  HostTime disabled_since_{};
  bool was_enabled_ = false;
};

}  // namespace interpolated_motion::simulation
