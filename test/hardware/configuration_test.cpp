#include <stdexcept>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

struct BadConfiguration {
  const char* name;
  const char* changes;             ///< merged into a good configuration of two joints
  std::vector<const char*> parts;  ///< of the message
};

const BadConfiguration kBad[] = {
    {"UnknownKey", "{commit_horizont: 2.0}", {"commit_horizont", "unknown", "commit_horizon"}},
    {"UnknownKeyOfADrive", "{drives: {joint1: {gear: 3}}}", {"drives/joint1/gear", "gear_ratio"}},
    {"WrongType", "{commit_horizon: soon}", {"commit_horizon", "\"soon\"", "number", "0.1..60"}},
    {"OutOfRange", "{commit_horizon: 0.001}", {"commit_horizon", "0.001", "0.1..60"}},
    {"NodeIdOutOfRange", "{drives: {joint1: {node_id: 128}}}", {"drives/joint1/node_id", "128", "1..127"}},
    {"TwoJointsOnOneNode", "{drives: {joint2: {node_id: 1}}}", {"drives/joint2/node_id", "joint1", "can0"}},
    {"NodeOfTheHost", "{drives: {joint2: {node_id: 127}}}", {"drives/joint2/node_id", "host_node_id"}},
    {"UnknownBus", "{drives: {joint2: {bus: can7}}}", {"drives/joint2/bus", "can7"}},
    {"UnknownBitrate", "{buses: {can0: {bitrate: 12345}}}", {"buses/can0/bitrate", "12345", "1000000"}},
    {"UnknownTransport",
     "{buses: {can0: {transport: telepathy}}}",
     {"buses/can0/transport", "telepathy", "emulated"}},
    {"JointWithoutDrive", "{joints: [joint1, joint2, joint3]}", {"drives/joint3", "missing"}},
    {"DriveWithoutJoint", "{joints: [joint1]}", {"drives/joint2", "unknown"}},
    {"JointTwice", "{joints: [joint1, joint1]}", {"joints", "joint1", "twice"}},
    {"WiderThanTheUrdf",
     "{drives: {joint1: {limits: {max_velocity: 5.0}}}}",
     {"max_velocity", "5", "3.5", "URDF"}},
    {"DirectionZero", "{drives: {joint1: {direction: 0}}}", {"direction", "1, -1"}},
    {"NoCounts", "{drives: {joint1: {counts_per_revolution: 0}}}", {"counts_per_revolution", "0"}},
    {"BoundBelowRounding", "{drives: {joint1: {deviation_bound: 0.1}}}", {"deviation_bound", "0.1"}},
    {"StreamBoundBelowThatOfGoals",
     "{drives: {joint1: {stream_deviation_bound: 0.8}}}",
     {"drives/joint1/stream_deviation_bound", "0.8", "1..1000000"}},
    {"ConstraintOfUnknownJoint", "{constraints: {joint9: {goal: 0.1}}}", {"constraints/joint9", "unknown"}},
    {"BusTooSlow", "{buses: {can0: {bitrate: 50000}}}", {"can0", "sync_period"}},
    {"DisciplineIsYesOrNo",
     "{buses: {can0: {clock_discipline: sometimes}}}",
     {"buses/can0/clock_discipline", "sometimes"}},
    {"FeedbackTimeoutWithinWhatASyncWaits",
     "{buses: {can0: {heartbeat_timeout: 2.0, sync_period: 0.01, feedback_timeout: 0.5}}}",
     {"buses/can0/feedback_timeout", "0.5", "0.52..60"}},
    {"RecorderTooShort", "{flight_recorder: {seconds: 0.5}}", {"flight_recorder/seconds", "0.5", "1..600"}},
    {"RecorderTooLarge",
     "{flight_recorder: {megabytes: 2000}}",
     {"flight_recorder/megabytes", "2000", "0.1..1024"}},
    {"RecorderWritesSometimes",
     "{flight_recorder: {write: sometimes}}",
     {"flight_recorder/write", "sometimes", "on_fault, on_request, never"}},
    {"RecorderWithoutAFolder", "{flight_recorder: {folder: ''}}", {"flight_recorder/folder", "empty"}},
    {"RecorderKeepsNothing", "{flight_recorder: {keep: 0}}", {"flight_recorder/keep", "0", "1..1000"}},
    {"RecorderUnknownKey", "{flight_recorder: {minutes: 1}}", {"flight_recorder/minutes", "unknown"}},
    {"HeartbeatTooTight", "{buses: {can0: {heartbeat_timeout: 0.1}}}", {"heartbeat_timeout", "1.5"}},
};

const BadConfiguration kBadCyclic[] = {
    {"PeriodThatIsNoWholeMillisecond",
     "{buses: {can0: {sync_period: 0.0025}}}",
     {"buses/can0/sync_period", "0.0025", "joint1", "0.001..0.02"}},
    {"PeriodTooLong", "{buses: {can0: {sync_period: 0.05}}}", {"buses/can0/sync_period", "0.05"}},
    {"BusTooSlowForThePeriod", "{buses: {can0: {sync_period: 0.001}}}", {"can0", "sync_period", "6 drives"}},
    {"OrderOutOfRange",
     "{drives: {joint1: {interpolation_order: 4}}}",
     {"drives/joint1/interpolation_order", "4", "1..3"}},
    {"SamplesLongerThanThePeriod",
     "{buses: {can0: {sync_period: 0.004}}, drives: {joint3: {servo_period: 0.005}}}",
     {"drives/joint3/servo_period", "0.005", "can0"}},
    {"StreamBoundOfACyclicDrive",
     "{drives: {joint1: {stream_deviation_bound: 8}}}",
     {"drives/joint1/stream_deviation_bound", "unknown"}},
    {"OnALine",
     "{buses: {line0: {type: silverlode}}, drives: {joint2: {bus: line0}}}",
     {"drives/joint2/bus", "cyclic", "canopen"}},
    {"NodeIdTwice", "{drives: {joint2: {node_id: 1}}}", {"drives/joint2/node_id", "joint1"}},
    {"RideThroughOutOfRange",
     "{drives: {joint1: {emulation: {ride_through: 101}}}}",
     {"drives/joint1/emulation/ride_through", "101", "0..100"}},
};

class BadCyclicConfigurationIsRefused : public ::testing::TestWithParam<BadConfiguration> {};

TEST_P(BadCyclicConfigurationIsRefused, WithParameterValueAndRange) {
  try {
    hardware::parse_configuration(six_axis_cyclic(GetParam().changes), six_axis_urdf());
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    for (const char* part : GetParam().parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, BadCyclicConfigurationIsRefused, ::testing::ValuesIn(kBadCyclic),
                         [](const ::testing::TestParamInfo<BadConfiguration>& bad) {
                           return std::string(bad.param.name);
                         });

class BadConfigurationIsRefused : public ::testing::TestWithParam<BadConfiguration> {};

TEST_P(BadConfigurationIsRefused, WithParameterValueAndRange) {
  try {
    hardware::parse_configuration(arm_of(2, GetParam().changes), six_axis_urdf());
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    for (const char* part : GetParam().parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, BadConfigurationIsRefused, ::testing::ValuesIn(kBad),
                         [](const ::testing::TestParamInfo<BadConfiguration>& bad) {
                           return bad.param.name;
                         });

TEST(Configuration, JointOutsideTheUrdfIsRefused) {
  auto urdf = six_axis_urdf();
  urdf.erase("joint2");
  try {
    hardware::parse_configuration(arm_of(2), urdf);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("joint2"), std::string::npos) << error.what();
  }
}

TEST(Configuration, LimitsComeFromTheUrdfAndMayBeTightened) {
  const auto configuration = hardware::parse_configuration(
      arm_of(2, "{drives: {joint2: {limits: {max_velocity: 1.0, max_position: 2.0}}}}"), six_axis_urdf());
  EXPECT_DOUBLE_EQ(configuration.drives[0].limits.max_velocity, 3.5);
  EXPECT_DOUBLE_EQ(configuration.drives[0].limits.max_acceleration, 20.0);
  EXPECT_DOUBLE_EQ(configuration.drives[1].limits.max_velocity, 1.0);
  EXPECT_DOUBLE_EQ(configuration.drives[1].limits.max_position, 2.0);
  EXPECT_DOUBLE_EQ(configuration.drives[1].limits.min_position, -3.1);
}

TEST(Configuration, TimeStampsComeAboutEachTenMilliseconds) {
  hardware::BusConfiguration bus;
  EXPECT_EQ(bus.time_stamp_period(), 1);
  bus.sync_period = 0.1;
  EXPECT_EQ(bus.time_stamp_period(), 1);
  bus.sync_period = 0.001;
  EXPECT_EQ(bus.time_stamp_period(), 10);
  bus.sync_period = 0.003;
  EXPECT_EQ(bus.time_stamp_period(), 4);
  bus.clock_discipline = false;
  EXPECT_EQ(bus.time_stamp_period(), 0);
}

TEST(Configuration, KeysOfTheNodeAreItsOwnBusiness) {
  EXPECT_NO_THROW(hardware::parse_configuration(arm_of(2, "{state_publish_rate: 50}"), six_axis_urdf(),
                                                {"state_publish_rate"}));
}

}  // namespace
}  // namespace interpolated_motion::test
