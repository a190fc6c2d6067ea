#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Where joints really are changes without jerks, in motion and while they brake: acceleration over 30 ms
/// within the limit. Joints whose drive or bus has a fault, and all where the host was away, may brake as
/// they can.
class Braking : public Invariant {
 public:
  explicit Braking(const Ledger& ledger) : Invariant(ledger), tracks_(ledger.arm().joints.size()) {}

  std::string name() const override { return "braking"; }
  void look(const Look& look) override;

 private:
  struct Track {
    HostTime time{};
    double position = 0.0;
    double step = 0.0;  ///< s, from the look before
    double velocity = 0.0;
    int known = 0;
  };

  void check(std::size_t joint, double position, HostTime now);

  std::vector<Track> tracks_;
};

}  // namespace interpolated_motion::simulation
