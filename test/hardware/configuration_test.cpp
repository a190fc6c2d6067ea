#include <map>
#include <stdexcept>
#include <string>

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
    {"MisspelledKey", "{commit_horizn: 2.0}", {"commit_horizn", "did you mean commit_horizon?"}},
    {"MisspelledKeyOfADrive",
     "{drives: {joint1: {gear_rato: 3}}}",
     {"drives/joint1/gear_rato", "did you mean gear_ratio?"}},
    {"SlashInAName", "{joints: [joint1, arm/joint2]}", {"joints", "\"arm/joint2\"", "slash"}},
    {"EmptyBus", "{drives: {joint1: {bus: ''}}}", {"drives/joint1/bus", "empty"}},
    {"EmptyInterface",
     "{buses: {can0: {transport: socketcan, interface: ''}}}",
     {"buses/can0/interface", "empty"}},
    {"EmptyDevice",
     "{buses: {line0: {type: silverlode, transport: serial, device: ''}}}",
     {"buses/line0/device", "empty"}},
    {"PositionBeyondTheCounter",
     "{drives: {joint1: {emulation: {initial_position: 100000}}}}",
     {"drives/joint1/emulation/initial_position", "100000", "3183098862 counts", "2147483647"}},
    {"LimitBeyondTheCounter",
     "{drives: {joint1: {gear_ratio: 1000000, counts_per_revolution: 100000000}}}",
     {"drives/joint1/limits/min_position", "-3.1", "counts", "2147483647"}},
    {"PlanMarginBeyondThatOfTheDrive",
     "{drives: {joint1: {limit_margin: 1.1, plan_margin: 1.2}}}",
     {"drives/joint1/plan_margin", "1.2", "1..1.1"}},
    {"StartTooFarAhead", "{max_start_ahead: 0.5}", {"max_start_ahead", "0.5", "1..1000000"}},
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
    {"SyncToleranceBeyondHalfAPeriod",
     "{buses: {can0: {sync_period: 0.004, sync_tolerance: 0.003}}}",
     {"buses/can0/sync_tolerance", "0.003", "4e-05..0.002"}},
    {"BusTooSlowForThePeriod", "{buses: {can0: {sync_period: 0.001}}}", {"can0", "sync_period", "6 drives"}},
    {"OrderOutOfRange",
     "{drives: {joint1: {interpolation_order: 4}}}",
     {"drives/joint1/interpolation_order", "4", "1..3"}},
    {"SamplesLongerThanThePeriod",
     "{buses: {can0: {sync_period: 0.004}}, drives: {joint3: {servo_period: 0.005}}}",
     {"drives/joint3/servo_period", "0.005", "can0"}},
    {"StreamBoundOfACyclicDrive",
     "{drives: {joint1: {stream_deviation_bound: 4}}}",
     {"drives/joint1/stream_deviation_bound", "4", "5..1000000"}},
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

TEST(Configuration, ToleranceOfSyncGrowsWithItsPeriod) {
  const auto tolerance = [](const char* bus) {
    return hardware::parse_configuration(arm_of(2, bus), six_axis_urdf()).buses[0].sync_tolerance;
  };
  EXPECT_DOUBLE_EQ(tolerance("{buses: {can0: {sync_period: 0.01}}}"), 0.0005);
  EXPECT_DOUBLE_EQ(tolerance("{buses: {can0: {sync_period: 0.02}}}"), 0.001);
  EXPECT_DOUBLE_EQ(tolerance("{buses: {can0: {sync_period: 0.02, sync_tolerance: 0.01}}}"), 0.01);
}

TEST(Configuration, KeysOfTheNodeAreItsOwnBusiness) {
  EXPECT_NO_THROW(hardware::parse_configuration(arm_of(2, "{state_publish_rate: 50}"), six_axis_urdf(),
                                                {"state_publish_rate"}));
}

std::string refusal_of(const YAML::Node& parameters,
                       const std::map<std::string, trajectory::JointLimits>& urdf = six_axis_urdf()) {
  try {
    hardware::parse_configuration(parameters, urdf);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

TEST(Configuration, UnderTheNameOfAControllerIsToldAsThat) {
  YAML::Node parameters;
  parameters["arm_controller"] = six_axis();
  const std::string text = refusal_of(parameters);
  EXPECT_NE(text.find("Parameter joints is missing, and there is arm_controller/joints"), std::string::npos)
      << text;
}

TEST(Configuration, ThatIsNoMapIsToldAsThat) {
  EXPECT_EQ(refusal_of(YAML::Load("[joint1, joint2]")),
            "The configuration is a list; it must be a map with the keys joints, buses and drives.");
}

TEST(Configuration, WithAKeyTwiceIsRefused) {
  YAML::Node parameters = arm_of(1);
  parameters["setpoints"] = YAML::Load("{delay: 0.1, delay: 0.2}");
  EXPECT_EQ(refusal_of(parameters), "Parameter setpoints/delay is given twice; leave one of both out.");
}

// A URDF in which nobody has thought of the velocity.
TEST(Configuration, GivesAJointTheVelocityLimitThatTheUrdfLacks) {
  auto urdf = six_axis_urdf();
  urdf["joint1"].max_velocity = 0.0;
  const std::string text = refusal_of(arm_of(1), urdf);
  EXPECT_NE(text.find("drives/joint1/limits/max_velocity is missing, and the URDF says 0"), std::string::npos)
      << text;
  const auto given =
      hardware::parse_configuration(arm_of(1, "{drives: {joint1: {limits: {max_velocity: 2.5}}}}"), urdf);
  EXPECT_EQ(given.drives[0].limits.max_velocity, 2.5);
  EXPECT_NE(refusal_of(arm_of(1, "{drives: {joint1: {limits: {max_velocity: 0}}}}"), urdf)
                .find("max_velocity is 0"),
            std::string::npos);
}

}  // namespace
}  // namespace interpolated_motion::test
