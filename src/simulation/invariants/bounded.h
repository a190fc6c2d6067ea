#pragma once

#include <string>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// What is kept and told stays bounded: lines of log in a second, texts.
class Bounded : public Invariant {
 public:
  explicit Bounded(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "bounded"; }
  void look(const Look& look) override;

 private:
  HostTime second_{};
  std::size_t lines_ = 0;
};

}  // namespace interpolated_motion::simulation
