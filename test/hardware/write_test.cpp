#include <cmath>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Position commands of joint handles, as a ros_control loop writes them.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

class WrittenCommands : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  }

  void command(double position) {
    for (const auto& joint : scenario.driver().joints()) *joint.position_command = position;
  }

  /// A loop of 500 Hz for `duration`; `command_at(t)` gives the command.
  template <class Command>
  void loop(double duration, Command command_at) {
    constexpr HostDuration kPeriod = std::chrono::milliseconds(2);
    const HostTime begin = now;
    for (; now < begin + host_duration(duration); now += kPeriod) {
      scenario.driver().read(now, kPeriod);
      command(command_at(seconds(now - begin)));
      if (auto refusal = scenario.driver().write(now, kPeriod)) last = refusal->text;
    }
  }

  Scenario scenario;
  HostTime now = scenario.now();
  std::string last;
};

TEST_F(WrittenCommands, AreFollowed) {
  now = scenario.now();
  loop(3.0, [](double t) { return 0.2 * (1.0 - std::cos(3.14159265 * std::min(t, 2.0))); });
  EXPECT_EQ(last, "");
  for (const auto& joint : scenario.driver().joints()) EXPECT_NEAR(*joint.position, 0.0, 2e-3);
  const auto snapshot = scenario.snapshot();
  EXPECT_EQ(snapshot.state, GroupState::Streaming);
  EXPECT_NEAR(static_cast<double>(snapshot.setpoints.accepted), 150.0, 2.0) << "one in 20 ms";
  EXPECT_EQ(snapshot.setpoints.refused, 0U);
}

TEST_F(WrittenCommands, NothingMovesWhileThereIsNone) {
  now = scenario.now();
  loop(0.5, [](double) { return std::nan(""); });
  EXPECT_EQ(last, "");
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  EXPECT_EQ(scenario.snapshot().setpoints.refused, 0U);
}

TEST_F(WrittenCommands, AJumpIsRefusedAndNothingMoves) {
  now = scenario.now();
  loop(0.5, [](double) { return 2.9; });
  EXPECT_NE(last.find("cannot be reached"), std::string::npos) << last;
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  for (const auto& joint : scenario.driver().joints()) EXPECT_EQ(*joint.position, 0.0);
}

}  // namespace
}  // namespace interpolated_motion::test
