#include "interpolated_motion_driver/node/diagnostics.h"

#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

motion::JointSnapshot healthy() {
  motion::JointSnapshot joint;
  joint.joint = "joint1";
  joint.online = true;
  joint.state = "Operation enabled";
  return joint;
}

DiagnosticStatus diagnose(const motion::JointSnapshot& joint,
                          hardware::BusType bus = hardware::BusType::Canopen) {
  DiagnosticStatus status;
  diagnose_drive(joint, bus, status);
  return status;
}

std::string value_of(const DiagnosticStatus& status, const std::string& key) {
  for (const auto& value : status.values)
    if (value.key == key) return value.value;
  return "not told";
}

TEST(DriveDiagnostics, AHealthyDriveTellsItsState) {
  const auto status = diagnose(healthy());
  EXPECT_EQ(status.level, Level::OK);
  EXPECT_EQ(status.message, "Operation enabled");
}

TEST(DriveDiagnostics, ASilentDriveIsAnError) {
  auto joint = healthy();
  joint.online = false;
  EXPECT_EQ(diagnose(joint).level, Level::ERROR);
}

TEST(DriveDiagnostics, AnErrorCodeIsToldWithItsText) {
  auto joint = healthy();
  joint.state = "Fault";
  joint.error_code = 0x8611;
  joint.error_text = "following error";
  const auto status = diagnose(joint);
  EXPECT_EQ(status.level, Level::ERROR);
  EXPECT_NE(status.message.find("8611"), std::string::npos);
  EXPECT_NE(status.message.find("following error"), std::string::npos);
}

// CiA 402: 0x0027 operation enabled, bit 9 remote, bit 10 target reached; SilverLode's polling status: bit 3
// kill motor, bit 8 moving error.
TEST(DriveDiagnostics, StatuswordsAreHexadecimalWithTheNamesOfTheirBits) {
  auto joint = healthy();
  joint.statusword = 0x0627;
  EXPECT_EQ(value_of(diagnose(joint), "statusword"), "operation enabled, target reached, remote (0x0627)");
  joint.statusword = 0x0108;
  const std::string text = value_of(diagnose(joint, hardware::BusType::Silverlode), "statusword");
  EXPECT_NE(text.find("kill"), std::string::npos) << text;
  EXPECT_NE(text.find("moving error"), std::string::npos) << text;
  EXPECT_NE(text.find("(0x0108)"), std::string::npos) << text;
}

TEST(DriveDiagnostics, LengthsAreInMetres) {
  auto joint = healthy();
  joint.following_error = 0.0005;
  EXPECT_EQ(value_of(diagnose(joint), "following error"), "0.000500 rad");
  joint.unit = trajectory::JointUnit::Metre;
  EXPECT_EQ(value_of(diagnose(joint), "following error"), "0.000500 m");
}

TEST(DriveDiagnostics, ABufferThatRanDryIsAWarning) {
  auto joint = healthy();
  joint.underruns = 2;
  EXPECT_EQ(diagnose(joint).level, Level::WARN);
}

TEST(DriveDiagnostics, ARecordNotTakenIsAWarning) {
  auto joint = healthy();
  joint.refused_writes = 1;
  EXPECT_EQ(diagnose(joint).level, Level::WARN);
}

TEST(BusDiagnostics, WarnsAboveTheConfiguredLoad) {
  motion::BusSnapshot bus;
  bus.load = 0.5;
  DiagnosticStatus status;
  diagnose_bus(bus, 0.6, status);
  EXPECT_EQ(status.level, Level::OK);
  bus.load = 0.7;
  diagnose_bus(bus, 0.6, status);
  EXPECT_EQ(status.level, Level::WARN);
}

TEST(BusDiagnostics, RepliesLaterThanPlannedAreAWarningThatSaysWhatToSet) {
  motion::BusSnapshot bus;
  bus.name = "line0";
  bus.reply_delay = motion::ReplyDelay{0.0025, 0.002};
  DiagnosticStatus status;
  diagnose_bus(bus, 0.6, status);
  EXPECT_EQ(status.level, Level::OK);
  bus.reply_delay = motion::ReplyDelay{0.016, 0.002};
  diagnose_bus(bus, 0.6, status);
  EXPECT_EQ(status.level, Level::WARN);
  for (const char* part : {"16.0 ms", "2.0 ms", "buses/line0/turnaround", "0.016"})
    EXPECT_NE(status.message.find(part), std::string::npos) << status.message;
}

TEST(GroupDiagnostics, AFaultIsAnErrorWithItsReason) {
  motion::Snapshot snapshot;
  snapshot.state = motion::GroupState::Fault;
  snapshot.fault = "joint3 is lost";
  DiagnosticStatus status;
  diagnose_group(snapshot, std::chrono::microseconds(3460), status);
  EXPECT_EQ(status.level, Level::ERROR);
  EXPECT_EQ(status.message, "joint3 is lost");
  ASSERT_EQ(status.values.size(), 1U);
  EXPECT_EQ(status.values[0].value, "3.5 ms");
}

}  // namespace
}  // namespace interpolated_motion::node
