#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Whatever state the host has a drive in: when it is told to switch all off, or ends, every drive that can be
// reached is without power.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

struct Case {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
  /// What makes the host find a fault of joint2, whose drive has none or is out of reach for a while.
  std::vector<std::pair<std::string, std::string>> faults;
  std::vector<std::pair<std::string, std::string>> ends;
};

const Case kCases[] = {
    {"EposLostRecord", six_axis, {{"can0", "drop_id 0x202 1"}}, {}},
    {"EposSilent", six_axis, {{"joint2", "silence 1"}}, {{"joint2", "silence 0"}}},
    {"EposRestarted", six_axis, {{"joint2", "power_cycle 0.1"}}, {}},
    {"CyclicSilent", six_axis_cyclic, {{"joint2", "silence 1"}}, {{"joint2", "silence 0"}}},
    {"CyclicRestarted", six_axis_cyclic, {{"joint2", "power_cycle 0.1"}}, {}},
    {"SilverlodeSilent", six_axis_silverlode, {{"joint2", "silence 1"}}, {{"joint2", "silence 0"}}},
    {"SilverlodeLine", six_axis_silverlode, {{"line0", "lose_replies 60"}}, {}},
    {"SilverlodeRestarted", six_axis_silverlode, {{"joint2", "power_cycle 0.1"}}, {}},
};

class PowerOff : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  }

  void inject(const std::vector<std::pair<std::string, std::string>>& faults) {
    std::string reason;
    for (const auto& [target, command] : faults)
      ASSERT_TRUE(scenario.driver().inject(target, command, &reason, scenario.now())) << reason;
  }

  void move_into_the_fault() {
    ASSERT_TRUE(scenario.submit(make_goal({3.0}, {{0.6, 0.6, 0.6, 0.6, 0.6, 0.6}})));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(0.5);
    inject(GetParam().faults);
    ASSERT_TRUE(scenario.run_until_state(GroupState::Fault, 20.0));
  }

  void come_back() {
    inject(GetParam().ends);
    scenario.run(1.5);
    ASSERT_EQ(scenario.state(), GroupState::Fault);
  }

  void expect_all_off() {
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_FALSE(*scenario.driver().emulated_power(i)) << "joint" << i + 1;
  }

  Scenario scenario{GetParam().make("")};
};

TEST_P(PowerOff, DisableReachesADriveInFault) {
  move_into_the_fault();
  come_back();
  const auto result = scenario.result_of_request(scenario.driver().enable(false, scenario.now()), 5.0);
  EXPECT_FALSE(result.success) << "it is in fault";
  EXPECT_EQ(scenario.state(), GroupState::Fault) << "only a reset ends a fault";
  expect_all_off();
}

TEST_P(PowerOff, TheEndOfTheNodeReachesADriveInFault) {
  move_into_the_fault();
  come_back();
  scenario.result_of_request(scenario.driver().shut_down(scenario.now()), 5.0);
  expect_all_off();
}

TEST_P(PowerOff, AtRestToo) {
  inject(GetParam().faults);
  scenario.run(4.0);
  inject(GetParam().ends);
  scenario.run(1.5);
  scenario.result_of_request(scenario.driver().shut_down(scenario.now()), 5.0);
  expect_all_off();
}

// A drive that has been lost may have restarted, somewhere else by its own counter: it does not count as
// there for being told to switch off.
TEST_P(PowerOff, LeavesALostDriveOffline) {
  inject(GetParam().faults);
  scenario.run(4.0);
  inject(GetParam().ends);
  scenario.run(1.5);
  const bool lost = !scenario.snapshot().joints[1].online;
  const auto request = scenario.driver().enable(false, scenario.now());
  for (int i = 0; lost && i < 400; ++i) {
    scenario.run(0.005);
    ASSERT_FALSE(scenario.snapshot().joints[1].online) << scenario.snapshot().joints[1].state;
  }
  scenario.result_of_request(request, 5.0);
  expect_all_off();
}

// Asked while the drive is out of reach, the request is answered, and says what could not be done; asked
// again, it is done.
TEST_P(PowerOff, IsTriedAgainWithTheNextRequest) {
  move_into_the_fault();
  scenario.result_of_request(scenario.driver().enable(false, scenario.now()), 5.0);
  inject(GetParam().ends);
  scenario.run(1.5);
  scenario.result_of_request(scenario.driver().enable(false, scenario.now()), 5.0);
  expect_all_off();
}

TEST_P(PowerOff, AndThenAllCanBeResetAndEnabled) {
  move_into_the_fault();
  come_back();
  scenario.result_of_request(scenario.driver().enable(false, scenario.now()), 5.0);
  const auto reset = scenario.result_of_request(scenario.driver().reset_faults(scenario.now()), 20.0);
  ASSERT_TRUE(reset.success) << reset.message;
  EXPECT_EQ(scenario.state(), GroupState::Disabled);
  expect_all_off();
  const auto on = scenario.result_of_request(scenario.driver().enable(true, scenario.now()), 5.0);
  EXPECT_TRUE(on.success) << on.message;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(*scenario.driver().emulated_power(i)) << "joint" << i + 1;
}

INSTANTIATE_TEST_SUITE_P(Kinds, PowerOff, ::testing::ValuesIn(kCases),
                         [](const ::testing::TestParamInfo<Case>& c) { return c.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
