/// Joints whose positions are lengths. What their mechanism makes of a length is told to the emulated world
/// in counts, and worked out here by hand.
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;
using trajectory::JointUnit;
using Urdf = std::map<std::string, trajectory::JointLimits>;

/// joint1 slides by 0..0.5 m at 0.25 m/s at most; joint2 turns.
Urdf slide_and_turn() {
  Urdf urdf = six_axis_urdf();
  urdf["joint1"].unit = JointUnit::Metre;
  urdf["joint1"].min_position = 0.0;
  urdf["joint1"].max_position = 0.5;
  urdf["joint1"].max_velocity = 0.25;
  return urdf;
}

/// What a drive of a kind needs besides its motor.
const std::map<std::string, std::string>& kinds() {
  static const std::map<std::string, std::string> kinds{
      {"epos_ipm", "bus: can0, node_id: 1"},
      {"cyclic", "bus: can0, node_id: 1"},
      {"silverlode_ims", "bus: line0, address: 16"},
  };
  return kinds;
}

/// joint1 alone. A motor of 4000 counts a revolution on a screw that moves the joint by 10 mm in one.
YAML::Node screw(const std::string& kind, const std::string& more = "travel_per_revolution: 0.01",
                 const std::string& emulation = "") {
  return YAML::Load(fmt::format(
      "{{joints: [joint1], buses: {{can0: {{type: canopen}}, line0: {{type: silverlode}}}}, drives: "
      "{{joint1: "
      "{{type: {}, {}, counts_per_revolution: 4000, limits: {{max_acceleration: 1.0}}, {}, emulation: "
      "{{{}}}}}}}}}",
      kind, kinds().at(kind), more, emulation));
}

YAML::Node with(YAML::Node yaml, const std::string& key, const std::string& value) {
  yaml[key] = YAML::Load(value);
  return yaml;
}

class PrismaticJoint : public testing::TestWithParam<const char*> {
 protected:
  /// Goes to `metres` and stands.
  motion::GoalResult move_to(double metres) {
    driver_->driver().set_motion_observer(
        [this](std::size_t, const hardware::DemandSample& sample) { demand_ = sample.demand; });
    EXPECT_TRUE(driver_->run_until_state(GroupState::Idle));
    const auto accepted = driver_->submit(make_goal({2.0}, {{metres}}));
    EXPECT_TRUE(accepted.has_value()) << accepted.error().text;
    if (!accepted.has_value()) return {};
    motion::GoalResult result = driver_->result_of(accepted.value().id);
    driver_->run(0.5);
    return result;
  }
  void start(const YAML::Node& yaml) { driver_ = std::make_unique<Scenario>(yaml, slide_and_turn()); }

  std::unique_ptr<Scenario> driver_;
  double demand_ = 0.0;  ///< counts, of the emulated drive
};

// 0.1 m are 10 turns of the screw.
TEST_P(PrismaticJoint, MovesAsManyTurnsOfItsScrewAsTheLengthTakes) {
  start(screw(GetParam()));
  EXPECT_EQ(move_to(0.1).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(demand_, 40000.0, 1.0);
  EXPECT_NEAR(driver_->positions()[0], 0.1, 1e-5);
}

// The encoder reads 0 with the joint at 0.02 m, and counts down on the way out.
TEST_P(PrismaticJoint, HasOffsetAndDirectionAsOthersHave) {
  start(screw(GetParam(), "travel_per_revolution: 0.01, direction: -1, offset: 0.02",
              "counts_at_0: 8000, counts_at_1: -392000, initial_position: 0.03"));
  ASSERT_TRUE(driver_->run_until_state(GroupState::Idle));
  EXPECT_NEAR(driver_->positions()[0], 0.03, 1e-5);
  EXPECT_EQ(move_to(0.1).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(demand_, -32000.0, 1.0);
  EXPECT_LT(driver_->driver().report().joints[0].worst_deviation, 20.0);
}

// A screw of 5 mm, taken for one of 10 mm: the driver cannot know, the emulated world does.
TEST_P(PrismaticJoint, AWrongScaleShows) {
  start(screw(GetParam(), "travel_per_revolution: 0.01", "counts_at_0: 0, counts_at_1: 800000"));
  EXPECT_EQ(move_to(0.1).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(*driver_->driver().emulated_position(0), 0.05, 1e-5);
  const motion::JointReport joint = driver_->driver().report().joints[0];
  EXPECT_NEAR(joint.final_deviation, 40000.0, 5.0);
  EXPECT_NEAR(joint.final_deviation * joint.count, 0.05, 1e-5);
  EXPECT_EQ(joint.unit, JointUnit::Metre);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, PrismaticJoint, testing::Values("epos_ipm", "cyclic", "silverlode_ims"),
                         [](const auto& kind) { return std::string(kind.param); });

// The same for a joint that turns: 50 revolutions of the motor taken for 100.
TEST(Mechanism, AWrongGearRatioShows) {
  Scenario driver(arm_of(1, "{drives: {joint1: {emulation: {counts_at_0: 0, counts_at_1: 15915.494309}}}}"));
  ASSERT_TRUE(driver.run_until_state(GroupState::Idle));
  const auto accepted = driver.submit(make_goal({2.0}, {{0.5}}));
  ASSERT_TRUE(accepted.has_value());
  EXPECT_EQ(driver.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(driver.driver().report().joints[0].final_deviation, 0.5 * 15915.494309, 2.0);
  EXPECT_NEAR(*driver.driver().emulated_position(0), 1.0, 1e-4);
}

std::string refusal_of(const YAML::Node& yaml, const Urdf& urdf = slide_and_turn()) {
  try {
    hardware::parse_configuration(yaml, urdf);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
}

TEST(PrismaticConfiguration, WantsATravelAndNoGearRatio) {
  expect_words(
      refusal_of(screw("epos_ipm", "gear_ratio: 100")),
      {"drives/joint1/gear_ratio", "prismatic", "leave it out", "travel_per_revolution, m of the joint"});
  expect_words(refusal_of(screw("epos_ipm", "gear_ratio: 2, travel_per_revolution: 0.01")),
               {"drives/joint1/gear_ratio", "prismatic"});
  expect_words(refusal_of(screw("epos_ipm", "direction: 1")),
               {"drives/joint1/travel_per_revolution is missing", "prismatic", "lead of the screw"});
  expect_words(refusal_of(screw("epos_ipm", "travel_per_revolution: 0")),
               {"travel_per_revolution is 0", "1000"});
  EXPECT_EQ(refusal_of(screw("epos_ipm")), "taken");
}

TEST(PrismaticConfiguration, OthersWantAGearRatioAndNoTravel) {
  expect_words(refusal_of(screw("epos_ipm"), six_axis_urdf()),
               {"drives/joint1/travel_per_revolution", "prismatic", "turns by the URDF", "gear_ratio"});
}

TEST(PrismaticConfiguration, DefaultsThatAreLengthsAreMillimetres) {
  const auto configuration = hardware::parse_configuration(screw("silverlode_ims"), slide_and_turn());
  const hardware::ConstraintConfiguration::Joint& joint = configuration.constraints.joints.at("joint1");
  EXPECT_DOUBLE_EQ(configuration.drives[0].max_following_error, 0.010);
  EXPECT_DOUBLE_EQ(joint.start, 0.005);
  EXPECT_DOUBLE_EQ(joint.stopped_velocity, 0.001);
}

TEST(PrismaticConfiguration, StartTolerancesAreOfEachJoint) {
  const auto start = [](const std::string& key, const std::string& value) {
    const auto yaml = with(screw("epos_ipm"), key, value);
    return hardware::parse_configuration(yaml, slide_and_turn()).constraints.joints.at("joint1").start;
  };
  EXPECT_DOUBLE_EQ(start("start_tolerance", "0.03"), 0.03);
  EXPECT_DOUBLE_EQ(start("constraints", "{joint1: {start: 0.002}}"), 0.002);
  const auto both =
      with(with(screw("epos_ipm"), "start_tolerance", "0.03"), "constraints", "{joint1: {start: 0}}");
  EXPECT_EQ(hardware::parse_configuration(both, slide_and_turn()).constraints.joints.at("joint1").start, 0.0);
  expect_words(refusal_of(with(screw("epos_ipm"), "constraints", "{joint1: {start: 11}}")),
               {"constraints/joint1/start is 11", "0..10"});
}

TEST(PrismaticConfiguration, TheEncoderReadsBothOrNeither) {
  expect_words(refusal_of(screw("epos_ipm", "travel_per_revolution: 0.01", "counts_at_0: 5")),
               {"drives/joint1/emulation/counts_at_1 is missing"});
  expect_words(refusal_of(screw("epos_ipm", "travel_per_revolution: 0.01", "counts_at_0: 5, counts_at_1: 5")),
               {"drives/joint1/emulation/counts_at_1 is 5", "must move"});
}

TEST(PrismaticConfiguration, LimitsAreToldInTheirUnit) {
  YAML::Node yaml = screw("epos_ipm");
  yaml["drives"]["joint1"]["limits"]["max_velocity"] = 0.3;
  expect_words(refusal_of(yaml), {"max_velocity is 0.3 m/s", "allows 0.25 m/s"});
}

TEST(PrismaticGoal, StartsWithinFiveMillimetres) {
  Scenario driver(screw("epos_ipm"), slide_and_turn());
  ASSERT_TRUE(driver.run_until_state(GroupState::Idle));
  const auto refused = driver.submit(make_goal({0.0, 1.0}, {{0.006}, {0.02}}));
  ASSERT_TRUE(refused.has_error());
  expect_words(refused.error().text, {"starts at 0.006 m", "difference of 0.005 m"});
  EXPECT_TRUE(driver.submit(make_goal({0.0, 1.0}, {{0.004}, {0.02}})).has_value());
}

}  // namespace
}  // namespace interpolated_motion::test
