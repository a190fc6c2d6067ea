#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "interpolated_motion_driver/hardware/recorder_tap.h"
#include "interpolated_motion_driver/protocol/canopen/frame_text.h"
#include "interpolated_motion_driver/recording/recording.h"
#include "interpolated_motion_driver/recording/recording_file.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::test {
namespace {

using recording::parse_recording;

std::string text_of(Scenario& scenario) { return to_text(scenario.driver().recording(), "a test"); }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

trajectory::Goal long_goal() { return make_goal({4.0}, {std::vector<double>(6, 1.0)}); }

class FlightRecorderOf : public testing::TestWithParam<const char*> {
 protected:
  static YAML::Node arm() {
    const std::string kind = GetParam();
    return kind == "epos" ? six_axis() : kind == "cyclic" ? six_axis_cyclic() : six_axis_mixed();
  }
};

TEST_P(FlightRecorderOf, HasEveryFrameAndLineInTheOrderOfTheWire) {
  Scenario scenario(arm());
  std::vector<std::string> seen;
  scenario.driver().set_wire_observer(
      {[&seen](const std::string& bus, const canopen::ReceivedFrame& frame) {
         seen.push_back(recording::time_text(frame.time) + " wire " + bus + (frame.own ? " > " : " < ") +
                        canopen::to_string(frame.frame) + "\n");
       },
       [&seen](const std::string& bus, const hardware::SerialText& line) {
         seen.push_back(recording::time_text(line.time) + " wire " + bus + (line.from_host ? " > " : " < ") +
                        std::string(line.text) + "\n");
       }});
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle));
  const std::string text = text_of(scenario);
  EXPECT_GT(seen.size(), 100U);
  for (const std::string& line : seen) ASSERT_TRUE(has(text, line)) << line;
}

TEST_P(FlightRecorderOf, HasOrdersStatesCourseAndTheFault) {
  Scenario scenario(arm());
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle));
  const HostTime sent = scenario.now();
  const auto accepted = scenario.submit(long_goal());
  ASSERT_TRUE(accepted);
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Moving));
  scenario.run(0.5);
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint1", "silence 1", &reason, scenario.now())) << reason;
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Fault));
  scenario.run(0.1);
  const std::string text = text_of(scenario);
  const auto file = parse_recording(text);
  ASSERT_EQ(file.orders.size(), 2U);
  EXPECT_EQ(file.orders[0].time, sent);
  EXPECT_EQ(file.orders[0].verb, "goal");
  EXPECT_EQ(file.orders[1].arguments["command"].as<std::string>(), "silence 1");
  ASSERT_EQ(file.faults.size(), 1U);
  EXPECT_EQ(file.faults[0].text, scenario.snapshot().fault);
  EXPECT_LE(file.faults[0].time, scenario.now());
  EXPECT_TRUE(has(text, " end goal 1 aborted -1: ")) << "its result was taken";
  EXPECT_TRUE(has(text, " -> moving\n"));
  EXPECT_TRUE(has(text, " joint joint6 "));
  EXPECT_TRUE(has(text, " drive joint1 offline, "));
  EXPECT_TRUE(has(text, " log error: "));
}

INSTANTIATE_TEST_SUITE_P(Arms, FlightRecorderOf, testing::Values("epos", "cyclic", "mixed"));

TEST(FlightRecorderOfADriver, TellsThatTheHostWasAway) {
  Scenario scenario;
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle));
  const HostTime from = scenario.now();
  scenario.driver().stall(from + host_duration(0.2));
  scenario.driver().stall(from + host_duration(0.3));
  const auto file = parse_recording(text_of(scenario));
  ASSERT_EQ(file.orders.size(), 1U);
  EXPECT_EQ(file.orders[0].verb, "absence");
  EXPECT_EQ(file.orders[0].time, from);
  EXPECT_EQ(recording::parse_time(file.orders[0].arguments["until"].as<std::string>()),
            from + host_duration(0.3));
}

// On real buses the driver lives on the times at which it is called.
TEST(RecorderTap, ACallThatIsMuchTooLateIsAnAbsence) {
  const auto at = [](double time) { return HostTime{} + host_duration(time); };
  hardware::RecorderTap tap(hardware::parse_configuration(six_axis(), six_axis_urdf()), HostTime{});
  tap.note_call(kNever, at(1.0));
  tap.note_call(at(1.0), at(1.04));
  EXPECT_TRUE(parse_recording(to_text(tap.recorder().recording(at(2.0)), "a test")).orders.empty());
  tap.note_call(at(2.0), at(2.06));
  const auto file = parse_recording(to_text(tap.recorder().recording(at(3.0)), "a test"));
  ASSERT_EQ(file.orders.size(), 1U);
  EXPECT_EQ(file.orders[0].time, at(2.0));
  EXPECT_EQ(recording::parse_time(file.orders[0].arguments["until"].as<std::string>()), at(2.06));
}

TEST(FlightRecorderOfADriver, ItsConfigurationIsParsedAgain) {
  Scenario scenario(six_axis_mixed());
  const auto file = parse_recording(text_of(scenario));
  const auto again = hardware::parse_configuration(file.configuration, file.limits);
  EXPECT_EQ(again.joints.size(), 6U);
  EXPECT_EQ(again.source, hardware::parse_configuration(six_axis_mixed(), six_axis_urdf()).source);
}

}  // namespace
}  // namespace interpolated_motion::test
