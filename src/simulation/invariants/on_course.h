#pragma once

#include <cstdint>
#include <string>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Where nothing went wrong from outside, every drive sample of a goal that has succeeded was on its path
/// within the deviation bound, by the driver's own report, and nothing ran dry or over. A goal that has taken
/// over in motion has the wider bound of streams. Cyclic drives may go without a target position for each
/// SYNC that the host was late with.
class OnCourse : public Invariant {
 public:
  explicit OnCourse(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "on course"; }
  void look(const Look& look) override;
  void goal_ended(const GoalEntry& goal) override;

 private:
  void judge(const Look& look);
  std::uint32_t allowed_underruns(const Joint& joint) const;

  motion::GoalId ended_ = 0;
  bool met_motion_ = false;
  HostTime rested_{};  ///< last seen without a motion under way
};

}  // namespace interpolated_motion::simulation
