#include "interpolated_motion_driver/commissioning/can_scan.h"

#include <gtest/gtest.h>

#include "bench.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/transport/stranger.h"

namespace interpolated_motion::commissioning {
namespace {

using emulation::CyclicDrive;
using emulation::CyclicParameters;
using emulation::EposDrive;
using emulation::EposParameters;
using emulation::EposVariant;

EposParameters epos(std::uint8_t node, EposVariant variant = EposVariant::Epos2) {
  EposParameters parameters;
  parameters.node_id = node;
  parameters.serial_number = 1000U + node;
  parameters.variant = variant;
  return parameters;
}

CyclicParameters cyclic(std::uint8_t node) {
  CyclicParameters parameters;
  parameters.node_id = node;
  return parameters;
}

canopen::Frame frame(std::uint32_t id, std::uint8_t length = 0, std::uint8_t first = 0) {
  canopen::Frame made;
  made.id = id;
  made.length = length;
  made.data[0] = first;
  return made;
}

struct CanScanTest : testing::Test, CanBench {
  CanScan scan(bool beside_master = false) { return scan_can(session, beside_master); }
};

TEST_F(CanScanTest, TellsEachDriveByWhatItSaysOfItself) {
  world.add<EposDrive>(bus, epos(3));
  world.add<CyclicDrive>(bus, cyclic(127));
  const CanScan found = scan();
  ASSERT_EQ(found.devices.size(), 2U);
  const CanDevice& first = found.devices[0];
  EXPECT_EQ(first.node, 3);
  EXPECT_EQ(first.device_type, 0x20192U);          // CiA 402, servo drive
  EXPECT_EQ(first.identity.vendor, 0xFBU);         // maxon motor
  EXPECT_EQ(first.identity.product, 0x64200000U);  // EPOS2 70/10
  EXPECT_EQ(first.identity.revision, 0x21260000U);
  EXPECT_EQ(first.identity.serial, 1003U);
  EXPECT_EQ(first.name, "EPOS2");
  EXPECT_EQ(first.fifo, 64U);  // EPOS3 Interpolated Position Mode, 60C4h:1
  EXPECT_EQ(drive_type(first), "epos_ipm");
  EXPECT_EQ(found.devices[1].node, 127);
  EXPECT_EQ(drive_type(found.devices[1]), "cyclic");
  EXPECT_TRUE(remarks(found).empty());

  const std::string text = to_text(first);
  for (const char* part :
       {"node 3: maxon EPOS2 70/10, firmware 0x2126 (\"EPOS2\")", "serial number 1003",
        "homing, interpolated position (0x00000065)", "switch on disabled", "can be used, type: epos_ipm"})
    EXPECT_TRUE(contains(text, part)) << part << " is not in\n" << text;
}

TEST_F(CanScanTest, SendsNothingButRequestsToRead) {
  world.add<EposDrive>(bus, epos(1));
  scan();
  EXPECT_GT(requests.size(), 127U);
  for (const canopen::Frame& request : requests) {
    // CiA 301, 7.2.4.3: initiate upload, upload segment with either toggle bit, and the end of what has had
    // no answer.
    const unsigned command = request.data[0];
    EXPECT_TRUE(command == 0x40 || command == 0x60 || command == 0x70 || command == 0x80)
        << std::hex << command;
  }
  EXPECT_EQ(bus.statistics().frames - requests.size(), session.traffic().frames());
}

TEST_F(CanScanTest, ADriveWithoutAModeOfThisDriverIsNotUsable) {
  // EPOS4: no interpolated position mode, yet the cyclic synchronous one.
  world.add<EposDrive>(bus, epos(5, EposVariant::Epos4));
  CanDevice device = scan().devices.at(0);
  EXPECT_EQ(drive_type(device), "cyclic");
  device.modes = 0x25;  // profile position and velocity, homing
  EXPECT_TRUE(contains(why_unusable(device), "neither the interpolated position mode of EPOS2 (7) nor"));
  device.modes = 0x65;  // and interpolated position, without EPOS2's buffer
  EXPECT_TRUE(contains(why_unusable(device), "is not that of EPOS2"));
  device.device_type = 0x000F0191;  // CiA 401
  EXPECT_TRUE(contains(why_unusable(device), "no servo drive: device type 0x1000 is 0x000F0191"));
}

TEST_F(CanScanTest, AnotherMasterIsToldAndNobodyIsAsked) {
  world.add<EposDrive>(bus, epos(1));
  auto& other = bus.stranger();
  session.listen(std::chrono::milliseconds(300));
  ASSERT_TRUE(other.send(frame(0x080), world.now()));  // SYNC
  const CanScan found = scan();
  EXPECT_TRUE(requests.empty());
  EXPECT_FALSE(found.asked);
  EXPECT_TRUE(found.devices.empty());
  ASSERT_FALSE(remarks(found).empty());
  EXPECT_TRUE(
      contains(remarks(found)[0], "another master is on the bus, perhaps the driver node: SYNC (1 frame)"));
  EXPECT_TRUE(contains(remarks(found)[0], "--beside-master"));
  EXPECT_EQ(scan(true).devices.size(), 1U);
}

TEST_F(CanScanTest, AHeartbeatWithoutAnswersIsToldByItsNodeId) {
  session.listen(std::chrono::milliseconds(10));
  ASSERT_TRUE(bus.stranger().send(frame(0x77F, 1, 5), world.now()));
  const CanScan found = scan();
  EXPECT_TRUE(found.asked);
  ASSERT_EQ(found.mute, std::vector<std::uint8_t>{127});
  EXPECT_TRUE(contains(remarks(found).at(0), "node 127 is heard but answers no SDO"));
}

TEST_F(CanScanTest, TwoDevicesOfOneNodeIdAreTold) {
  world.add<EposDrive>(bus, epos(4));
  world.add<EposDrive>(bus, epos(6));
  bus.stranger().repeat(0x584, 1000);
  const CanScan found = scan();
  ASSERT_EQ(found.devices.size(), 2U);
  EXPECT_TRUE(contains(to_text(found.devices[0]), "cannot be used: two devices answer as node 4"));
  EXPECT_TRUE(contains(to_text(found.devices[1]), "can be used"));
}

TEST_F(CanScanTest, AnAnswerThatIsLostIsAskedForOnceMore) {
  world.add<EposDrive>(bus, epos(4));
  int lost = 0;
  bus.drop_if([&lost](const canopen::Frame& f) { return f.id == 0x584 && ++lost % 4 == 1; });
  const CanScan found = scan();
  ASSERT_EQ(found.devices.size(), 1U);
  EXPECT_EQ(drive_type(found.devices[0]), "epos_ipm");
  EXPECT_FALSE(found.devices[0].twice);
}

// Nobody acknowledges there, so that nothing leaves the queue.
TEST_F(CanScanTest, AnEmptyBusIsAskedWithinSeconds) {
  std::size_t told = 0;
  const HostTime begin = world.now();
  const CanScan found = scan_can(session, false, [&told](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 127U);
    told = done;
  });
  EXPECT_TRUE(found.devices.empty());
  EXPECT_EQ(told, 127U);
  EXPECT_LT(seconds(world.now() - begin), 6.0);
}

}  // namespace
}  // namespace interpolated_motion::commissioning
