#include "interpolated_motion_driver/commissioning/line_scan.h"

#include <gtest/gtest.h>

#include "bench.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

namespace interpolated_motion::commissioning {
namespace {

using emulation::SilverDust;
using emulation::SilverDustParameters;

SilverDustParameters drive(int address, std::int32_t position = 0) {
  SilverDustParameters parameters;
  parameters.address = address;
  parameters.initial_position = position;
  return parameters;
}

struct LineScanTest : testing::Test, LineBench {};

TEST_F(LineScanTest, TellsEachDriveByItsAddress) {
  world.add<SilverDust>(line, drive(16, -4000));
  world.add<SilverDust>(line, drive(254));
  const LineScan found = scan_line(session);
  ASSERT_EQ(found.devices.size(), 2U);
  EXPECT_EQ(found.devices[0].address, 16);
  EXPECT_EQ(found.devices[0].revision, 31);
  EXPECT_EQ(found.devices[0].position, -4000);
  EXPECT_EQ(found.devices[0].trouble, "");
  EXPECT_EQ(found.devices[1].address, 254);
  EXPECT_TRUE(found.remarks.empty());
  const std::string text = to_text(found.devices[0]);
  for (const char* part : {"address 16: QuickSilver SilverLode, revision 31", "-4000 counts",
                           "can be used, type: silverlode_ims"})
    EXPECT_TRUE(contains(text, part)) << part << " is not in\n" << text;
}

// Command Reference: 5 RVN, 12 RRG and 20 RIS read; no status is cleared.
TEST_F(LineScanTest, SendsNothingButRequestsToRead) {
  world.add<SilverDust>(line, drive(16));
  scan_line(session);
  ASSERT_GE(requests.size(), 254U);
  for (const std::string& request : requests) {
    const std::string command = request.substr(request.find(' ') + 1);
    EXPECT_TRUE(command == "5" || command == "20" || command == "12 1") << request;
  }
}

TEST_F(LineScanTest, TwoDrivesOfOneAddressAreTold) {
  SilverDustParameters second = drive(20);
  second.turnaround = std::chrono::microseconds(1500);
  world.add<SilverDust>(line, drive(20));
  world.add<SilverDust>(line, second);
  world.add<SilverDust>(line, drive(21));
  const LineScan found = scan_line(session);
  ASSERT_EQ(found.devices.size(), 2U);
  EXPECT_TRUE(contains(to_text(found.devices[0]), "cannot be used: its answers are spoilt or come twice"));
  EXPECT_TRUE(contains(found.devices[0].trouble, "two drives have address 20"));
  EXPECT_EQ(found.devices[1].trouble, "");
}

TEST_F(LineScanTest, DrivesThatAnswerLateAreTold) {
  SilverDustParameters late = drive(16);
  late.ack_delay = 416;  // 50 ms
  world.add<SilverDust>(line, late);
  late.address = 17;
  world.add<SilverDust>(line, late);
  const LineScan found = scan_line(session);
  EXPECT_TRUE(found.devices.empty());
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_TRUE(contains(found.remarks[0], "Scan again with a longer --timeout than 0.020 s"));
}

TEST(LineScan, FindsDrivesThatAnswerLateWithMorePatience) {
  silverlode::LineParameters patient;
  patient.reply_timeout = std::chrono::milliseconds(80);
  LineBench bench({}, patient);
  SilverDustParameters late = drive(16);
  late.ack_delay = 416;  // 50 ms
  bench.world.add<SilverDust>(bench.line, late);
  EXPECT_EQ(scan_line(bench.session).devices.size(), 1U);
}

TEST_F(LineScanTest, NoiseIsTold) {
  world.add<SilverDust>(line, drive(16));
  line.inject(transport::SerialDirection::DriveToHost, "*zz\r", world.now() + std::chrono::seconds(2));
  const LineScan found = scan_line(session);
  EXPECT_EQ(found.devices.size(), 1U);
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_TRUE(contains(found.remarks[0], "lines that were no replies: 1, the last \"*zz\": another rate"));
}

TEST_F(LineScanTest, ASilentLineIsAskedWithinSeconds) {
  const LineScan found = scan_line(session);
  EXPECT_TRUE(found.devices.empty());
  EXPECT_EQ(found.characters, 0U);
  EXPECT_LT(seconds(world.now() - HostTime{}), 12.0);
}

TEST(SilentLine, TheSentenceFollowsFromWhatWasHeard) {
  EXPECT_TRUE(contains(silent_line_advice(57'600, 0, 115'200).at(0),
                       "nobody answers at 57600 bit/s, but at 115200: give --baud 115200"));
  EXPECT_TRUE(contains(silent_line_advice(57'600, 12, 0).at(0), "12 characters were heard at 57600 bit/s"));
  EXPECT_TRUE(contains(silent_line_advice(57'600, 0, 0).at(0), "the line is silent at every rate"));
}

}  // namespace
}  // namespace interpolated_motion::commissioning
