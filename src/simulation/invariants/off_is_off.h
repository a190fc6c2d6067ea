#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// When a request to switch off has been answered, the motor of every drive that could be reached is without
/// power, whatever the group says of it, and stays so until somebody asks for power.
class OffIsOff : public Invariant {
 public:
  explicit OffIsOff(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "off is off"; }
  void look(const Look& look) override;
  void request_ended(const RequestEntry& request) override;

 private:
  bool is_reachable(std::size_t joint) const;

  HostTime asked_ =
      kNever;  ///< when the request was made that has been answered last; kNever: power may be on
};

}  // namespace interpolated_motion::simulation
