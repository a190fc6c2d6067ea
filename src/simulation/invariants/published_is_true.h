#pragma once

#include <string>
#include <vector>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Host and drive agree at rest on where a joint is, and what is published fits together: fault texts, active
/// goals, fills within capacities.
class PublishedIsTrue : public Invariant {
 public:
  explicit PublishedIsTrue(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "published is true"; }
  void look(const Look& look) override;

 private:
  void check_joint(std::size_t joint, const motion::JointSnapshot& published, const Look& look);
  bool rests(const Look& look);

  HostTime rest_since_ = kNever;
  std::vector<double> rest_;
};

/// The desired state that is published has no jumps: what moves does so within the velocity limit.
class DesiredIsSmooth : public Invariant {
 public:
  explicit DesiredIsSmooth(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "desired is smooth"; }
  void look(const Look& look) override;

 private:
  bool is_as_before(const motion::Snapshot& snapshot) const;

  std::vector<double> desired_;
  HostTime time_{};        ///< of `desired_`
  bool was_away_ = false;  ///< the host, and nothing new has been published since
  motion::GroupState state_ = motion::GroupState::Starting;
};

}  // namespace interpolated_motion::simulation
