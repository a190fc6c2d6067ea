#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "hardware/scenario.h"

namespace interpolated_motion::test {

/// What became of one goal on one arm without any fault.
struct Verdict {
  enum class Kind { Refused, Held, Broken };
  Kind kind = Kind::Refused;
  std::string text;  ///< of the refusal, or of what was not held
};

/// The kinds of goals of a sweep: few long records, fast and long ones, and as many records as there can be.
enum class SweepGoal { Slow, Fast, Dense };
inline constexpr SweepGoal kSweepGoals[] = {SweepGoal::Slow, SweepGoal::Fast, SweepGoal::Dense};
const char* name_of(SweepGoal goal);

/// A goal of `joints` joints from 0, each out of phase with the others, within 3.5 rad/s and 20 rad/s2.
trajectory::Goal sweep_goal(SweepGoal kind, int joints);

/// Brings an arm up and gives it the goal: accepted it must succeed, every joint within `bound` counts of its
/// path at every sample and nothing running dry.
Verdict verdict_of(const YAML::Node& arm, const trajectory::Goal& goal, double bound);

/// Which of `size` combinations to try: `usual` spread evenly over all of them, or as many as
/// IMD_PROPERTY_CASES says.
std::vector<int> sweep_sample(int size, int usual);

/// Counts verdicts, fails the test for what is broken, and prints the sums; with IMD_SWEEP_TEXT each verdict
/// too, a line each.
class SweepTally {
 public:
  explicit SweepTally(std::string name) : name_(std::move(name)) {}
  void add(const std::string& combination, const Verdict& verdict);
  void print() const;
  int accepted() const { return held_ + broken_; }
  int refused() const { return refused_; }

 private:
  std::string name_;
  int refused_ = 0;
  int held_ = 0;
  int broken_ = 0;
};

}  // namespace interpolated_motion::test
