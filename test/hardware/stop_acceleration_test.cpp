#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "trajectory/random.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kMaxAcceleration = 20.0;  // rad/s^2, of every joint of these arms

struct Kind {
  const char* name;
  YAML::Node (*arm)(const std::string&);
  const char* changes;
  double interval;  ///< s, over which differences are taken
  double
      rounding;  ///< rad/s^2: what whole counts, and the grid of the drive's samples, may pretend over that
  bool interpolates;  ///< in a stop as well: the demand is looked at, at each servo sample; else where the
                      ///< drive is
};

// The encoder of the cyclic drives is a hundred times finer than usual, so that a difference over a servo
// period is one of the interpolation and not of whole counts. The others brake by a profile of their own:
// whole counts, 31831 per rad, are up to 2 / 31831 / interval^2.
const Kind kKinds[] = {
    {"epos", six_axis, "", 0.020, 0.2, false},
    {"silverlode", six_axis_silverlode, "", 0.020, 0.2, false},
    {"cyclic", six_axis_cyclic,
     "{drives: {joint1: {counts_per_revolution: 200000, deviation_bound: 500}, "
     "joint2: {counts_per_revolution: 200000, deviation_bound: 500}, "
     "joint3: {counts_per_revolution: 200000, deviation_bound: 500}, "
     "joint4: {counts_per_revolution: 200000, deviation_bound: 500}, "
     "joint5: {counts_per_revolution: 200000, deviation_bound: 500}, "
     "joint6: {counts_per_revolution: 200000, deviation_bound: 500}}}",
     0.001, 0.7, true},
};

/// The largest acceleration of a joint, by differences of positions that come `interval` s after each other.
class Watch {
 public:
  explicit Watch(double interval) : interval_(interval) {}

  void take(double position) {
    const double velocity = (position - position_) / interval_;
    if (++known_ > 2) worst_ = std::max(worst_, std::abs(velocity - velocity_) / interval_);
    position_ = position;
    velocity_ = velocity;
  }
  double worst() const { return worst_; }

 private:
  double interval_;
  int known_ = 0;
  double position_ = 0.0;
  double velocity_ = 0.0;
  double worst_ = 0.0;
};

/// Every joint along a quintic from rest to rest, at up to 0.9 of its limits.
trajectory::Goal random_goal(trajectory::Random& random, const std::vector<double>& start) {
  trajectory::Goal goal;
  trajectory::Waypoint point;
  double duration = 0.1;
  for (std::size_t i = 0; i < start.size(); ++i) {
    goal.joint_names.push_back("joint" + std::to_string(i + 1));
    const double target = random.uniform(-2.0, 2.0);
    const double distance = std::abs(target - start[i]);
    point.positions.push_back(target);
    duration = std::max({duration, 1.875 * distance / (0.9 * 3.5),
                         std::sqrt(10.0 / std::sqrt(3.0) * distance / (0.9 * kMaxAcceleration))});
  }
  point.time = GoalTime{duration};
  point.velocities.assign(start.size(), 0.0);
  point.accelerations.assign(start.size(), 0.0);
  goal.points = {point};
  return goal;
}

class StopAcceleration : public ::testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    scenario.driver().set_motion_observer([this](std::size_t joint, const emulation::DemandSample& sample) {
      if (kind.interpolates && joint < watches.size()) watches[joint].take(sample.demand / kCounts);
    });
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  }

  /// Until everything rests, with a look each interval.
  void run(double duration) {
    for (double time = 0.0; time < duration; time += kLook) {
      scenario.run(kLook);
      for (std::size_t i = 0; i < watches.size() && !kind.interpolates; ++i)
        watches[i].take(*scenario.driver().emulated_position(i));
    }
  }

  double worst_of_a_stop(motion::GoalId goal) {
    watches.assign(6, Watch(kind.interval));
    const auto halt = scenario.driver().halt(scenario.now());
    run(1.0);
    EXPECT_TRUE(scenario.result_of_request(halt, 0.1).success);
    EXPECT_EQ(scenario.result_of(goal, 0.1).outcome, GoalOutcome::Aborted);
    double worst = 0.0;
    for (const Watch& watch : watches) worst = std::max(worst, watch.worst());
    watches.clear();
    return worst;
  }

  static constexpr double kLook = 0.020;  // s
  static constexpr double kCounts =
      200000 * 100 / (2.0 * 3.14159265358979324);  // per rad, of the cyclic drives
  const Kind kind = GetParam();
  std::vector<Watch> watches;
  Scenario scenario{kind.arm(kind.changes)};
};

// At every sample from the halt on until they rest.
TEST_P(StopAcceleration, OfStopsAtRandomInstantsIsWithinTheLimit) {
  trajectory::Random random(1);
  double worst = 0.0;
  for (int n = 0; n < trajectory::property_cases(20); ++n) {
    const auto accepted = scenario.submit(random_goal(random, scenario.positions()));
    ASSERT_TRUE(accepted) << accepted.error().text;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(random.uniform(0.05, 0.9));
    if (scenario.state() != GroupState::Moving) continue;
    const double found = worst_of_a_stop(accepted.value().id);
    EXPECT_LE(found, 1.05 * kMaxAcceleration + kind.rounding) << n;
    worst = std::max(worst, found);
  }
  EXPECT_GE(worst, 0.5 * kMaxAcceleration) << "nothing has been stopped";
  std::printf("%s: %d stops, worst %.2f rad/s^2 at a limit of %.0f\n", kind.name,
              trajectory::property_cases(20), worst, kMaxAcceleration);
}

INSTANTIATE_TEST_SUITE_P(Kinds, StopAcceleration, ::testing::ValuesIn(kKinds),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
