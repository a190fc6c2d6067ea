#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"
#include "hardware/scenario.h"
#include "hardware/silverlode/line_traffic.h"
#include "hardware/sine_timing.h"

// All drives of a line started by one command to the global address.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr int kIms = 253;
constexpr double kTick = 120e-6;  ///< s
constexpr double kTogether = 1e-3;
constexpr std::size_t kJoints = 6;
/// Of the arm of scenario.h: 4000 x 50 counts per revolution of the joint.
constexpr double kCountsPerRadian = 200'000.0 / (2.0 * kPi);
/// "@16 253 0 0" CR and "* 10" CR at 57600 baud, 11 bits each, and the 1 ms of an emulated drive in between:
/// what each IMS takes at least.
constexpr double kExchange = 17 * 11 / 57600.0 + 0.001;

YAML::Node arm(const std::string& start, const std::string& changes = "") {
  YAML::Node yaml = six_axis_silverlode(changes);
  for (const char* line : {"line0", "line1"}) yaml["buses"][line]["start"] = start;
  return yaml;
}

/// Ticks of the drives are anywhere.
constexpr const char* kPhases =
    "{drives: {joint1: {emulation: {tick_phase: 0.00001}}, joint2: {emulation: {tick_phase: 0.0001}}, "
    "joint3: {emulation: {tick_phase: 0.00005}}, joint4: {emulation: {tick_phase: 0.00011}}}}";

/// When the interpolated motion of each drive began, by its own samples.
class Begins {
 public:
  explicit Begins(Scenario& scenario) : begins_(kJoints, kNever) {
    scenario.driver().set_sample_observer([this](std::size_t joint, const hardware::DemandSample& sample) {
      begins_[joint] = std::min(begins_[joint], sample.time);
    });
  }

  bool all() const {
    return std::all_of(begins_.begin(), begins_.end(), [](HostTime begin) { return begin != kNever; });
  }
  /// From the first to the last of the drives `first` .. `first` + 2, those of one line, s.
  double skew(std::size_t first) const {
    const auto from = begins_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto [least, most] = std::minmax_element(from, from + 3);
    return seconds(*most - *least);
  }

 private:
  std::vector<HostTime> begins_;
};

struct Skew {
  double line0 = 0.0;
  double line1 = 0.0;
};

Skew skew_of_start(const std::string& start) {
  Scenario scenario(arm(start, kPhases));
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  Begins begins(scenario);
  const auto accepted = scenario.submit(make_goal({1.0}, {{0.2, -0.2, 0.2, 0.1, -0.1, 0.1}}));
  if (!accepted) {
    ADD_FAILURE() << accepted.error().text;
    return {};
  }
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_TRUE(begins.all());
  return {begins.skew(0), begins.skew(3)};
}

TEST(GlobalStart, BeginsTheDrivesOfALineWithinOneServoTick) {
  const Skew global = skew_of_start("global");
  EXPECT_LE(global.line0, kTick);
  EXPECT_LE(global.line1, kTick);
  const Skew addressed = skew_of_start("addressed");
  EXPECT_GE(addressed.line0, 2.0 * kExchange - kTick) << "one IMS after the other";
  EXPECT_GE(addressed.line1, 2.0 * kExchange - kTick);
  std::printf("start skew of three drives: global %.0f us, %.0f us; addressed %.0f us, %.0f us\n",
              1e6 * global.line0, 1e6 * global.line1, 1e6 * addressed.line0, 1e6 * addressed.line1);
}

TEST(GlobalStart, TakesOneCommandOfEachLine) {
  for (const auto& [start, commands] :
       std::map<std::string, std::uint64_t>{{"global", 2}, {"addressed", 6}}) {
    Scenario scenario(arm(start));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    LineTraffic traffic(scenario);
    const auto accepted = scenario.submit(make_goal({1.0}, {{0.2, -0.2, 0.2, 0.1, -0.1, 0.1}}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
    EXPECT_EQ(traffic.commands(kIms), commands) << start;
  }
}

class GlobalStarts : public testing::TestWithParam<const char*> {};

// A planner's goal, then the sine whose steep parts tell how far each drive is.
TEST_P(GlobalStarts, GoTogetherAlongThePath) {
  YAML::Node yaml = std::string(GetParam()) == "mixed" ? six_axis_mixed(kPhases) : arm("global", kPhases);
  yaml["buses"]["line0"]["start"] = "global";
  Scenario scenario(yaml);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  SineTiming timing(scenario, kJoints, kCountsPerRadian);
  const auto accepted = scenario.submit(sine_goal(kJoints, 4.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_GT(timing.looks(), 1000U);
  EXPECT_LE(timing.worst_spread(), kTogether);
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation, 2.0) << joint.joint;
    EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, GlobalStarts, testing::Values("two_lines", "mixed"),
                         [](const testing::TestParamInfo<const char*>& arm) { return arm.param; });

TEST(GlobalStart, OfDrivesThatAreFedThroughRegisters) {
  YAML::Node yaml = arm("global", kPhases);
  for (int i = 1; i <= 6; ++i) yaml["drives"]["joint" + std::to_string(i)]["queue"] = "register";
  Scenario scenario(yaml);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  for (const double way : {0.2, 0.0}) {
    const auto accepted = scenario.submit(make_goal({1.5}, {{way, -way, way, way, -way, way}}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    const auto result = scenario.result_of(accepted.value().id);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    for (const auto& joint : scenario.driver().report().joints)
      EXPECT_LE(joint.worst_deviation, 2.0) << joint.joint;
  }
}

// Nobody answers a command to the global address, so a drive that has not heard it must be found by asking.
TEST(GlobalStart, ADriveThatMissesItStopsTheGroup) {
  Scenario scenario(arm("global"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint2", "nak 253 1 1", &reason, scenario.now())) << reason;
  const auto target = std::vector<double>{0.2, -0.2, 0.2, 0.1, -0.1, 0.1};
  const auto accepted = scenario.submit(make_goal({1.0}, {target}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  for (const char* part : {"Joint joint2 (line0 address 17)", "has not started at IMS \"@255 253 0 0\"",
                           "all drives of line0", "`addressed`"})
    EXPECT_TRUE(contains(result.text, part)) << result.text;
  scenario.run(1.0);
  for (const double position : scenario.positions())
    EXPECT_LE(std::abs(position), 1e-6) << "all of them still waited for the common start";

  const auto reset = scenario.result_of_request(scenario.driver().reset_faults(scenario.now()));
  ASSERT_TRUE(reset.success) << reset.message;
  ASSERT_TRUE(scenario.result_of_request(scenario.driver().enable(true, scenario.now())).success);
  const auto again = scenario.submit(make_goal({1.0}, {target}));
  ASSERT_TRUE(again) << again.error().text;
  EXPECT_EQ(scenario.result_of(again.value().id).outcome, GoalOutcome::Succeeded);
}

// The command is garbled on the line: no drive has begun, none is waited for.
TEST(GlobalStart, ALineThatMissesItStopsTheGroup) {
  Scenario scenario(arm("global"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(make_goal({1.0}, {{0.2, -0.2, 0.2, 0.1, -0.1, 0.1}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("line1", "lose_requests 3", &reason, scenario.now())) << reason;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(contains(result.text, "has not started")) << result.text;
  EXPECT_TRUE(contains(result.text, "line1")) << result.text;
}

// A stop that comes before the command has left: the drives that hear it stop again.
TEST(GlobalStart, AStopRightAfterTheStartLeavesNothingBehind) {
  Scenario scenario(arm("global"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto first = scenario.submit(make_goal({1.0}, {{0.2, -0.2, 0.2, 0.1, -0.1, 0.1}}));
  ASSERT_TRUE(first) << first.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  scenario.driver().cancel(first.value().id, scenario.now());
  EXPECT_EQ(scenario.result_of(first.value().id).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
  const auto second = scenario.submit(make_goal({1.0}, {{0.2, -0.2, 0.2, 0.1, -0.1, 0.1}}));
  ASSERT_TRUE(second) << second.error().text;
  const auto result = scenario.result_of(second.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
}

void expect_refusal(const YAML::Node& yaml, const std::vector<std::string>& parts) {
  try {
    Scenario scenario(yaml);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& part : parts) EXPECT_TRUE(contains(error.what(), part)) << error.what();
  }
}

TEST(GlobalStartConfiguration, KnowsTwoWaysOnly) {
  expect_refusal(arm("together"), {"buses/line0/start", "together", "addressed, global"});
}

TEST(GlobalStartConfiguration, IsNothingForACanBus) {
  expect_refusal(six_axis("{buses: {can0: {start: global}}}"), {"buses/can0/start", "unknown"});
}

// One command has one set of arguments.
TEST(GlobalStartConfiguration, NeedsTheSameArgumentsForAllDrivesOfTheLine) {
  const std::string other = "{drives: {joint2: {ims_arguments: \"\"}}}";
  expect_refusal(arm("global", other),
                 {"drives/joint2/ims_arguments", "0 0", "joint1", "line0", "addressed"});
  EXPECT_NO_THROW(Scenario{arm("addressed", other)});
}

}  // namespace
}  // namespace interpolated_motion::test
