#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Errors of CANopen drives (EMCY, 0x1001, 0x1003): logged when they come, over when they are over, read
// before they are reset. For EPOS and cyclic drives.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

struct Arm {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
};

const Arm kArms[] = {{"Epos", six_axis}, {"Cyclic", six_axis_cyclic}};

class DriveError : public ::testing::TestWithParam<Arm> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  }

  void inject(const std::string& target, const std::string& command) {
    std::string reason;
    ASSERT_TRUE(scenario.driver().inject(target, command, &reason, scenario.now())) << reason;
  }

  motion::RequestResult request(motion::RequestId id) { return scenario.result_of_request(id); }

  /// How many lines of the log name joint1 and contain `part`.
  long logged(const std::string& part) {
    scenario.run(0.0);
    return std::count_if(scenario.log().begin(), scenario.log().end(), [&part](const std::string& line) {
      return line.find("joint1") != std::string::npos && line.find(part) != std::string::npos;
    });
  }

  std::uint16_t code() { return scenario.snapshot().joints[0].error_code; }

  Scenario scenario{GetParam().make("")};
};

TEST_P(DriveError, IsLoggedWhenItComesAndOverWhenItIsOver) {
  inject("joint1", "warning 0x4210");
  scenario.run(0.05);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  EXPECT_EQ(code(), 0x4210);
  EXPECT_EQ(logged("EMCY 0x4210"), 1);
  inject("joint1", "warning_over");
  scenario.run(0.05);
  EXPECT_EQ(code(), 0);
  EXPECT_EQ(scenario.snapshot().joints[0].error_text, "");
  EXPECT_EQ(logged("is over: EMCY 0x4210"), 1);
}

TEST_P(DriveError, WhoseEndWasNotHeardIsOverWithTheNextEnable) {
  inject("joint1", "warning 0x4210");
  scenario.run(0.05);
  inject("can0", "drop_id 0x081 1");
  inject("joint1", "warning_over");
  scenario.run(0.2);
  EXPECT_EQ(code(), 0x4210);
  ASSERT_TRUE(request(scenario.driver().enable(false, scenario.now())).success);
  ASSERT_TRUE(request(scenario.driver().enable(true, scenario.now())).success);
  EXPECT_EQ(code(), 0);
  EXPECT_EQ(logged("is over: EMCY 0x4210"), 1);
}

TEST_P(DriveError, ThatLastsIsNotOverForTheAskingOfEnable) {
  inject("joint1", "warning 0x4210");
  scenario.run(0.05);
  ASSERT_TRUE(request(scenario.driver().enable(false, scenario.now())).success);
  ASSERT_TRUE(request(scenario.driver().enable(true, scenario.now())).success);
  EXPECT_EQ(code(), 0x4210);
  EXPECT_EQ(logged("EMCY 0x4210"), 1);
}

TEST_P(DriveError, OfWhichNoMessageCameIsReadBeforeItIsReset) {
  inject("can0", "drop_id 0x081 1");
  inject("joint1", "emcy 0x7320");
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault));
  EXPECT_EQ(logged("0x7320"), 0);
  ASSERT_TRUE(request(scenario.driver().reset_faults(scenario.now())).success);
  EXPECT_EQ(logged("of which no message has come: EMCY 0x7320"), 1);
  EXPECT_EQ(code(), 0);
}

TEST_P(DriveError, ThatEndedInAResetIsOver) {
  inject("joint1", "emcy 0x7320");
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault));
  EXPECT_EQ(logged("reports EMCY 0x7320"), 1);
  EXPECT_EQ(code(), 0x7320);
  scenario.run(0.5);
  EXPECT_EQ(code(), 0x7320);
  ASSERT_TRUE(request(scenario.driver().reset_faults(scenario.now())).success);
  EXPECT_EQ(code(), 0);
  EXPECT_EQ(logged("is over: EMCY 0x7320"), 1);
}

// A drive that repeats itself fills no disk.
TEST_P(DriveError, ThatIsRepeatedIsLoggedOnce) {
  for (int i = 0; i < 100; ++i) {
    inject("joint1", "warning 0x4210");
    scenario.run(0.01);
  }
  EXPECT_EQ(logged("EMCY 0x4210"), 1);
}

TEST_P(DriveError, ThatChangesAllTheTimeIsLoggedInPart) {
  for (int i = 0; i < 50; ++i) {
    inject("joint1", "warning 0x4210");
    inject("joint1", "warning 0x3210");
    scenario.run(0.01);
  }
  EXPECT_LE(logged("EMCY 0x"), 10);
  scenario.run(1.0);
  inject("joint1", "warning 0x2310");
  scenario.run(0.05);
  EXPECT_EQ(logged("EMCY 0x2310"), 1);
  EXPECT_EQ(logged("more before)"), 1);
}

// Frames as they were in the field: 0x4210 and its end, in the middle of a goal that goes on.
TEST_P(DriveError, InMotionIsToldAndTheGoalGoesOn) {
  const auto accepted = scenario.submit(make_goal({2.0}, {{0.3, 0.3, 0.3, 0.3, 0.3, 0.3}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  scenario.run(0.5);
  inject("can0", "send 081#1042080000000000");
  scenario.run(0.05);
  EXPECT_EQ(code(), 0x4210);
  EXPECT_EQ(logged("EMCY 0x4210"), 1);
  inject("can0", "send 081#0000000000000000");
  scenario.run(0.05);
  EXPECT_EQ(code(), 0);
  EXPECT_EQ(logged("is over: EMCY 0x4210"), 1);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, motion::GoalOutcome::Succeeded);
}

// What came first may have caused what came then.
TEST_P(DriveError, ThatCameFirstIsNamedFirstInTheFault) {
  inject("joint1", "warning 0x4210");
  inject("joint1", "emcy 0x7320");
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault));
  const std::string fault = scenario.snapshot().fault;
  const std::size_t first = fault.find("EMCY 0x4210");
  ASSERT_NE(first, std::string::npos) << fault;
  EXPECT_LT(first, fault.find("then EMCY 0x7320")) << fault;
  EXPECT_NE(fault.find("then EMCY 0x7320"), std::string::npos) << fault;
  EXPECT_EQ(code(), 0x7320);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DriveError, ::testing::ValuesIn(kArms),
                         [](const ::testing::TestParamInfo<Arm>& arm) { return arm.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
