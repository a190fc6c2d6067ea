#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// When the group stops, all joints come to rest within a bounded time; so they do when the host dies.
class StopsTogether : public Invariant {
 public:
  explicit StopsTogether(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "stops together"; }
  void look(const Look& look) override;

 private:
  struct Mark {
    HostTime time{};
    std::vector<double> positions;
  };

  bool is_due(HostTime now) const;
  bool is_excused(std::size_t joint, HostTime now) const;

  HostTime stopping_since_ = kNever;
  Mark mark_;
};

}  // namespace interpolated_motion::simulation
