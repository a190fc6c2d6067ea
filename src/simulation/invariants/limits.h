#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// The demand of every drive keeps its joint's limits of position, velocity and acceleration at every sample,
/// by differences between samples 1 ms apart.
class Limits : public Invariant {
 public:
  explicit Limits(const Ledger& ledger) : Invariant(ledger), tracks_(ledger.arm().joints.size()) {}

  std::string name() const override { return "limits"; }
  void sample(const Sample& sample) override;

 private:
  struct Track {
    HostTime time = HostTime::min();
    double position = 0.0;
    double step = 0.0;  ///< s, from the sample before
    double velocity = 0.0;
    int known = 0;  ///< samples in a row, up to 2: of how many the velocity is known
  };

  bool is_not_led(const Joint& joint, HostTime when) const;
  const char* circumstance(HostTime when) const;
  void check_position(const Joint& joint, const Sample& sample);
  void check_motion(const Joint& joint, const Track& before, const Track& now);

  std::vector<Track> tracks_;
};

}  // namespace interpolated_motion::simulation
