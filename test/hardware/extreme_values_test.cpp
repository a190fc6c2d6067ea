#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Numbers and times at the ends of their types: refused with the figure, or answered with finite numbers.
// Bad goals are in bad_goal_test.cpp.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Arm {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
};

const Arm kArms[] = {{"Epos", six_axis},
                     {"Cyclic", six_axis_cyclic},
                     {"Silverlode", six_axis_silverlode},
                     {"Mixed", six_axis_mixed}};

class ExtremeValues : public ::testing::TestWithParam<Arm> {
 protected:
  void SetUp() override { ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)); }

  motion::Setpoint setpoint() {
    motion::Setpoint s;
    s.time = scenario.now();
    for (int i = 1; i <= 6; ++i) s.joint_names.push_back("joint" + std::to_string(i));
    s.positions.assign(6, 0.0);
    s.source = "test";
    return s;
  }

  /// Why `spoil`ed, a good setpoint is refused.
  std::string refusal_of(const std::function<void(motion::Setpoint&)>& spoil) {
    auto bad = setpoint();
    spoil(bad);
    const auto refusal = scenario.driver().setpoint(bad, scenario.now());
    return refusal ? refusal->text : "taken";
  }

  /// Both at rest and within a stream.
  void expect_refused(const std::function<void(motion::Setpoint&)>& spoil, const std::string& part) {
    const std::string text = refusal_of(spoil);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  void expect_bad_setpoints_refused() {
    expect_refused([](auto& s) { s.positions[2] = 1e308; },
                   "The position of joint \"joint3\" in the setpoint is 1e+308");
    expect_refused([](auto& s) { s.positions[2] = -2e9; }, "joint \"joint3\" in the setpoint is -2000000000");
    expect_refused([](auto& s) { s.positions[0] = kNan; }, "joint \"joint1\" in the setpoint is nan");
    expect_refused([](auto& s) { s.velocities = {0, 0, 0, 0, 0, 1e300}; },
                   "The velocity of joint \"joint6\" in the setpoint is 1e+300");
    expect_refused([](auto& s) { s.time = HostTime::max(); }, "too far ahead: 9");
    expect_refused([](auto& s) { s.time = HostTime::min(); }, "of the past: 9");
  }

  /// The arm's desired states at `time`, if there are any, are finite and within the limits.
  void expect_sane_answer(HostTime time) {
    std::vector<trajectory::State> states;
    if (!scenario.driver().query(time, states)) return;
    for (const trajectory::State& state : states) {
      EXPECT_LE(std::abs(state.position), 3.1);
      EXPECT_LE(std::abs(state.velocity), 3.5);
    }
  }

  Scenario scenario{GetParam().make("")};
};

TEST_P(ExtremeValues, SetpointsAreRefusedWithTheFigureAtRestAndInAStream) {
  expect_bad_setpoints_refused();
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  auto good = setpoint();
  ASSERT_FALSE(scenario.driver().setpoint(good, scenario.now()));
  for (int i = 0; i < 100; ++i) {
    scenario.run(0.02);
    good.time = scenario.now();
    const auto refusal = scenario.driver().setpoint(good, scenario.now());
    ASSERT_FALSE(refusal) << refusal->text;
  }
  scenario.run(0.01);
  ASSERT_EQ(scenario.state(), GroupState::Streaming);
  auto older = setpoint();
  older.time = HostTime::min();
  const auto refusal = scenario.driver().setpoint(older, scenario.now());
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("out of order: it is 9"), std::string::npos) << refusal->text;
  expect_refused([](auto& s) { s.positions[2] = 1e308; }, "is 1e+308");
  expect_refused([](auto& s) { s.time = HostTime::max(); }, "too far ahead: 9");
  EXPECT_EQ(scenario.state(), GroupState::Streaming);
}

TEST_P(ExtremeValues, PositionCommandsAreRefusedWithTheFigure) {
  for (const auto& joint : scenario.driver().joints()) *joint.position_command = 1e308;
  const auto refusal = scenario.driver().write(scenario.now(), HostDuration{});
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("joint1\" in the setpoint is 1e+308"), std::string::npos) << refusal->text;
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST_P(ExtremeValues, AStampWithinTheSpanIsWaitedForAndNoLonger) {
  Scenario brief(GetParam().make("{max_start_ahead: 3}"));
  ASSERT_TRUE(brief.run_until_state(GroupState::Idle));
  auto goal = make_goal({2.0}, {{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}});
  goal.start = brief.now() + std::chrono::milliseconds(3100);
  const auto refused = brief.submit(goal);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("3.1 s ahead"), std::string::npos) << refused.error().text;
  EXPECT_NE(refused.error().text.find("at most 3 s"), std::string::npos) << refused.error().text;
  goal.start = brief.now() + std::chrono::milliseconds(2900);
  const auto taken = brief.submit(goal);
  ASSERT_TRUE(taken) << taken.error().text;
  EXPECT_EQ(brief.result_of(taken.value().id).outcome, motion::GoalOutcome::Succeeded);
}

TEST_P(ExtremeValues, AGoalThatIsRefusedForItsStampLeavesTheOneUnderWay) {
  const auto first = scenario.submit(make_goal({2.0}, {{0.4, 0.4, 0.4, 0.4, 0.4, 0.4}}));
  ASSERT_TRUE(first) << first.error().text;
  scenario.run(1.0);
  auto late = make_goal({2.0}, {{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}});
  late.start = HostTime::max();
  EXPECT_FALSE(scenario.submit(late));
  EXPECT_EQ(scenario.result_of(first.value().id).outcome, motion::GoalOutcome::Succeeded);
}

TEST_P(ExtremeValues, StopRequestsStopWhateverTheirStamp) {
  const auto first = scenario.submit(make_goal({2.0}, {{0.4, 0.4, 0.4, 0.4, 0.4, 0.4}}));
  ASSERT_TRUE(first) << first.error().text;
  scenario.run(1.0);
  trajectory::Goal stop;
  stop.joint_names = setpoint().joint_names;
  stop.start = HostTime::max();
  ASSERT_TRUE(scenario.submit(stop));
  EXPECT_EQ(scenario.result_of(first.value().id).outcome, motion::GoalOutcome::Preempted);
}

TEST_P(ExtremeValues, QueriesAreAnsweredWithinTheLimits) {
  const auto first = scenario.submit(make_goal({2.0}, {{0.4, 0.4, 0.4, 0.4, 0.4, 0.4}}));
  ASSERT_TRUE(first) << first.error().text;
  for (int i = 0; i < 8; ++i) {
    for (const HostTime time : {HostTime::min(), HostTime{}, HostTime::max()}) expect_sane_answer(time);
    scenario.run(0.4);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExtremeValues, ::testing::ValuesIn(kArms),
                         [](const ::testing::TestParamInfo<Arm>& arm) { return arm.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
