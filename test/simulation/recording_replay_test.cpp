#include "simulation/recording_replay.h"

#include <string>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/recording/recording.h"
#include "simulation/script.h"
#include "simulation/simulation.h"

namespace interpolated_motion::simulation {
namespace {

/// Of the simulation at its driver.
constexpr double kLook = 0.005;

struct Kind {
  const char* name;
  const char* configuration;
  const char* fault;  ///< injected
  double poll;        ///< s, from one look at a drive to the next, docs/configuration.md
};

class ReplayOfARecording : public testing::TestWithParam<Kind> {
 protected:
  recording::RecordingFile record(const std::string& events) {
    std::string text;
    simulate_recorded(parse_script(GetParam().configuration + events), text);
    return recording::parse_recording(text);
  }

  static void expect_same(const recording::RecordingFile& file, double apart) {
    const Replayed outcome = replay(file);
    ASSERT_TRUE(outcome.recorded);
    ASSERT_TRUE(outcome.replayed) << "no fault where there was: " << outcome.recorded->text;
    EXPECT_EQ(outcome.replayed->text, outcome.recorded->text);
    EXPECT_NEAR(seconds(outcome.replayed->time - HostTime{}), seconds(outcome.recorded->time - HostTime{}),
                apart);
    EXPECT_EQ(outcome.answered_otherwise, 0U);
    EXPECT_TRUE(outcome.is_same());
  }
};

// Short: the recording begins with the driver.
TEST_P(ReplayOfARecording, HasTheFaultAtTheSameTime) {
  const auto file =
      record(std::string("at 0.5 goal points=4 shape=1 effort=0.1 reach=2 noise=4\nat 1.1 inject ") +
             GetParam().fault + "\n");
  EXPECT_TRUE(file.complete);
  expect_same(file, kLook);
}

// The goal is older than what the recorder keeps, and so is bring-up.
TEST_P(ReplayOfARecording, OfAGoalThatIsOlderThanTheRecording) {
  const auto file =
      record(std::string("at 5 goal points=4 shape=1 effort=0.01 reach=3 noise=4\nat 19 inject ") +
             GetParam().fault + "\n");
  EXPECT_FALSE(file.complete);
  ASSERT_FALSE(file.orders.empty());
  EXPECT_EQ(file.orders.front().verb, "goal");
  EXPECT_LT(file.orders.front().time, file.begin);
  expect_same(file, GetParam().poll + kLook);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ReplayOfARecording,
    testing::Values(
        Kind{"epos",
             "configuration {joints: [joint1], buses: {can0: {type: canopen}}, drives: {joint1: {bus: can0, "
             "type: "
             "epos_ipm, node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, limits: {max_acceleration: "
             "20}}}}\n",
             "joint1 emcy 0x2310", 0.01},
        Kind{"cyclic",
             "configuration {joints: [joint1], buses: {can0: {type: canopen}}, drives: {joint1: {bus: can0, "
             "type: "
             "cyclic, node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, limits: {max_acceleration: "
             "20}}}}\n",
             "can0 disconnect 1", 0.01},
        Kind{"silverlode",
             "configuration {joints: [joint1], buses: {line0: {type: silverlode}}, drives: {joint1: {bus: "
             "line0, "
             "type: silverlode_ims, address: 16, counts_per_revolution: 4000, gear_ratio: 50, limits: "
             "{max_acceleration: 20}}}}\n",
             "joint1 fault over_temperature", 0.05}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::simulation
