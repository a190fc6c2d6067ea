#include "interpolated_motion_driver/recording/flight_recorder.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/recording/recording_file.h"
#include "protocol/allocation_count.h"

namespace interpolated_motion::recording {
namespace {

using Answer = Expected<motion::GoalAcceptance, Refusal>;

HostTime at(double time) { return HostTime{} + host_duration(time); }

Subject subject() {
  Subject subject;
  subject.configuration = "{joints: [joint1, joint2]}";
  subject.limits["joint1"] = {-3.1, 3.1, 3.5, std::numeric_limits<double>::infinity(), false};
  subject.limits["joint1"].unit = trajectory::JointUnit::Metre;
  subject.joints = {"joint1", "joint2"};
  subject.buses = {"can0", "line0"};
  return subject;
}

canopen::ReceivedFrame frame(double time, std::uint32_t id, bool own) {
  canopen::ReceivedFrame received;
  received.frame.id = id;
  received.frame.length = 3;
  received.frame.data = {0x01, 0xAB, 0xFF};
  received.time = at(time);
  received.own = own;
  return received;
}

trajectory::Goal goal(double target) {
  trajectory::Goal goal;
  goal.joint_names = {"joint1", "joint2"};
  goal.points.push_back({GoalTime{0.1 + 0.2}, {target, -1e-300}, {0.0, 1.0 / 3.0}, {}, {}});
  return goal;
}

std::shared_ptr<const trajectory::Goal> shared(trajectory::Goal goal) {
  return std::make_shared<const trajectory::Goal>(std::move(goal));
}

Answer accepted(motion::GoalId id) { return motion::GoalAcceptance{id, GoalTime{1.0}, {}}; }

std::string text_of(const FlightRecorder& recorder, double now) {
  return to_text(recorder.recording(at(now)), "a test");
}

bool has(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(FlightRecorder, WritesAllThatCrossesTheBusesWithTimeAndDirection) {
  FlightRecorder recorder({}, subject(), at(0.0));
  recorder.frame("can0", frame(1.000000001, 0x601, true));
  recorder.frame("can0", frame(1.5, 0x181, false));
  recorder.line("line0", "@16 12", at(2.0), true);
  recorder.line("line0", "* 10\x02", at(2.25), false);
  const std::string text = text_of(recorder, 3.0);
  EXPECT_TRUE(has(text, "1.000000001 wire can0 > 601#01ABFF")) << text;
  EXPECT_TRUE(has(text, "1.500000000 wire can0 < 181#01ABFF")) << text;
  EXPECT_TRUE(has(text, "2.000000000 wire line0 > @16 12")) << text;
  EXPECT_TRUE(has(text, "2.250000000 wire line0 < * 10\\x02")) << text;
}

TEST(FlightRecorder, OrdersComeBackToTheLastBit) {
  FlightRecorder recorder({}, subject(), at(0.0));
  trajectory::Goal sent = goal(0.1);
  sent.start = at(5.123456789);
  sent.path_tolerance.push_back({"joint2", 0.2, -1.0, 0.0});
  recorder.goal(at(1.0), shared(sent), accepted(7));
  recorder.goal(at(2.0), shared(goal(std::numeric_limits<double>::quiet_NaN())),
                Refusal{GoalError::InvalidGoal, "no \"number\"\n: 1"});
  recorder.order(at(2.5), "cancel", "goal: 7");
  const RecordingFile file = parse_recording(text_of(recorder, 3.0));
  ASSERT_EQ(file.orders.size(), 3U);
  EXPECT_EQ(file.orders[0].time, at(1.0));
  EXPECT_EQ(file.orders[0].verb, "goal");
  EXPECT_EQ(file.orders[0].arguments["id"].as<int>(), 7);
  EXPECT_EQ(file.orders[0].arguments["answer"].as<std::string>(), "accepted");
  EXPECT_EQ(file.orders[1].arguments["answer"].as<std::string>(), "refused: no \"number\"\n: 1");
  EXPECT_EQ(file.orders[2].arguments["goal"].as<int>(), 7);
  EXPECT_TRUE(file.complete);
  EXPECT_EQ(file.begin, at(0.0));
  EXPECT_EQ(file.end, at(3.0));
  EXPECT_EQ(file.cause, "a test");
  EXPECT_EQ(file.limits.at("joint1").max_velocity, 3.5);
  EXPECT_EQ(file.limits.at("joint1").unit, trajectory::JointUnit::Metre);
  EXPECT_EQ(file.configuration["joints"][1].as<std::string>(), "joint2");
}

TEST(FlightRecorder, SetpointsAreOrdersWithTheirAnswers) {
  FlightRecorder recorder({}, subject(), at(0.0));
  motion::Setpoint setpoint{at(1.0), {"joint2", "joint1"}, {0.25, -0.5}, {1.0, 2.0}, "/teleop"};
  recorder.setpoint(at(1.25), setpoint, std::nullopt);
  setpoint.velocities.clear();
  recorder.setpoint(at(1.5), setpoint, Refusal{GoalError::InvalidGoal, "too old"});
  const std::string text = text_of(recorder, 3.0);
  EXPECT_TRUE(
      has(text,
          "1.250000000 order setpoint {time: 1.000000000, joint_names: [\"joint2\", \"joint1\"], positions: "
          "[0.25, -0.5], velocities: [1, 2], source: \"/teleop\", answer: accepted}"))
      << text;
  EXPECT_TRUE(
      has(text,
          "1.500000000 order setpoint {time: 1.000000000, joint_names: [\"joint2\", \"joint1\"], positions: "
          "[0.25, -0.5], answer: \"refused: too old\"}"))
      << text;
}

TEST(FlightRecorder, JointsAreLookedAtWithTheirBuffers) {
  FlightRecorder recorder({}, subject(), at(0.0));
  motion::Snapshot snapshot;
  snapshot.time = at(1.5);
  snapshot.joints.resize(2);
  motion::JointSnapshot& joint = snapshot.joints[1];
  joint.desired.position = 0.25;
  joint.desired.velocity = -2.0;
  joint.actual.position = 0.125;
  joint.actual.velocity = -1.5;
  joint.demand_position = 0.5;
  joint.fill_time = 0.75;
  recorder.look(snapshot);
  const std::string text = text_of(recorder, 3.0);
  EXPECT_TRUE(has(text, "1.500000000 joint joint2 0.25 -2 0.125 -1.5 0.5 0.75")) << text;
}

TEST(FlightRecorder, KeepsTheLastSecondsOnly) {
  FlightRecorder recorder({std::chrono::seconds(10)}, subject(), at(0.0));
  for (int i = 0; i < 300; ++i) recorder.frame("can0", frame(0.1 * i, 0x100, true));
  const std::string text = text_of(recorder, 29.9);
  EXPECT_FALSE(has(text, "19.800000000 wire can0 > 100#01ABFF"));
  EXPECT_TRUE(has(text, "19.900000000 wire can0 > 100#01ABFF")) << text;
  EXPECT_TRUE(has(text, "29.900000000 wire can0 > 100#01ABFF"));
  EXPECT_FALSE(parse_recording(text).complete);
  EXPECT_EQ(parse_recording(text).begin, at(19.9));
}

// A goal under way, and what came after it, however old; nothing that was over before.
TEST(FlightRecorder, KeepsOrdersInForce) {
  FlightRecorder recorder({std::chrono::seconds(10)}, subject(), at(0.0));
  recorder.goal(at(1.0), shared(goal(0.1)), accepted(1));
  recorder.ended(at(5.0), motion::GoalResult{1, motion::GoalOutcome::Succeeded, {}, ""});
  recorder.goal(at(6.0), shared(goal(0.2)), accepted(2));
  recorder.order(at(7.0), "inject", "target: can0");
  recorder.order(at(100.0), "halt", "request: 1");
  const RecordingFile file = parse_recording(text_of(recorder, 100.0));
  ASSERT_EQ(file.orders.size(), 3U);
  EXPECT_EQ(file.orders[0].time, at(6.0));
  EXPECT_EQ(file.orders[1].verb, "inject");
  recorder.ended(at(101.0), motion::GoalResult{2, motion::GoalOutcome::Aborted, {}, "halt"});
  recorder.order(at(105.0), "reset", "request: 2");
  EXPECT_EQ(parse_recording(text_of(recorder, 105.0)).orders.size(), 4U);
  recorder.order(at(112.0), "enable", "request: 3");
  EXPECT_EQ(parse_recording(text_of(recorder, 112.0)).orders.size(), 2U);
}

TEST(FlightRecorder, MemoryIsBoundedWhateverComes) {
  const std::size_t bytes = 200'000;
  FlightRecorder recorder({std::chrono::seconds(600), bytes}, subject(), at(0.0));
  motion::GoalId id = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double time = 0.001 * i;
    recorder.frame("can0", frame(time, 0x100, true));
    recorder.log(at(time), "info", std::string(static_cast<std::size_t>(i % 3000), 'x'));
    if (i % 3 != 0) continue;
    recorder.goal(at(time), shared(goal(0.1)), accepted(++id));
    if (id > 1) recorder.ended(at(time), motion::GoalResult{id, motion::GoalOutcome::Preempted, {}, ""});
    ASSERT_LE(recorder.used(), bytes);
  }
  const std::string text = text_of(recorder, 20.0);
  EXPECT_NE(text.find("goal {id: 1, "), std::string::npos) << "the goal under way is kept before all others";
  EXPECT_EQ(text.find("orders_left_out: 0\n"), std::string::npos);
  EXPECT_EQ(text.find("displaced: 0\n"), std::string::npos);
}

TEST(FlightRecorder, RecordsWithoutAllocation) {
  FlightRecorder recorder({std::chrono::seconds(1), 100'000}, subject(), at(0.0));
  const motion::Setpoint setpoint{at(1.0), {"joint2", "joint1"}, {0.25, -0.5}, {1.0, 2.0}, "/teleop"};
  motion::Snapshot snapshot;
  snapshot.joints.resize(2);
  recorder.setpoint(at(0.0), setpoint, std::nullopt);
  recorder.look(snapshot);
  const std::string can = "can0";
  const std::string line = "line0";
  const std::size_t before = test::allocation_count();
  for (int i = 0; i < 10'000; ++i) {
    const double time = 0.001 * i;
    recorder.frame(can, frame(time, 0x100, true));
    recorder.line(line, "@16 12 1000 2000 3000 4000 5000", at(time), true);
    recorder.setpoint(at(time), setpoint, std::nullopt);
    snapshot.time = at(time);
    recorder.look(snapshot);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(RecordingFile, WrongLinesAreToldByNumber) {
  const std::string head =
      "version: 1\ncause: x\nbegin: 0.000000000\nend: 1.000000000\ncomplete: true\nlimits: "
      "{}\nconfiguration: {}\n---\n";
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parse_recording(text);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal(head), "");
  EXPECT_NE(refusal(head + "1.000000000 order goal {a: [}\n").find("line 9"), std::string::npos);
  EXPECT_NE(refusal(head + "later order goal {}\n").find("later"), std::string::npos);
  EXPECT_NE(refusal("version: 2" + head.substr(10)).find("version is 2; this program reads 1"),
            std::string::npos);
  EXPECT_NE(refusal("").find("version"), std::string::npos);
}

}  // namespace
}  // namespace interpolated_motion::recording
