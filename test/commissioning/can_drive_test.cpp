#include "interpolated_motion_driver/commissioning/can_drive.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "bench.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

namespace interpolated_motion::commissioning {
namespace {

using emulation::EposDrive;
using emulation::EposParameters;

constexpr std::uint8_t kNode = 3;

canopen::Eds epos_sheet() {
  std::ifstream file(std::string(IMD_SOURCE_DIR) + "/config/eds/epos2_emulated.eds");
  std::stringstream text;
  text << file.rdbuf();
  return canopen::parse_eds(text.str(), kNode);
}

EposParameters parameters(std::uint32_t serial = 7) {
  EposParameters made;
  made.node_id = kNode;
  made.serial_number = serial;
  return made;
}

struct CanDriveTest : testing::Test, CanBench {
  CanDriveTest() { session.listen(std::chrono::milliseconds(300)); }

  /// "" when all went well.
  std::string written(const std::string& name, const std::string& value, DriveAccess& to) {
    auto change = to.prepare(name, value);
    if (!change) return change.error();
    const auto failure = to.apply(change.value());
    return failure ? *failure : "";
  }
  std::size_t writes() const {
    std::size_t count = 0;
    // CiA 301, 7.2.4.3.3: initiate download, expedited, of 1 to 4 bytes.
    for (const auto& request : requests) count += (request.data[0] & 0xF0U) == 0x20U ? 1 : 0;
    return count;
  }

  EposDrive& epos = world.add<EposDrive>(bus, parameters());
  CanDrive drive{session, kNode, epos_sheet()};
  CanDrive without_sheet{session, kNode, std::nullopt};
};

TEST_F(CanDriveTest, AValueIsShownWithWhatIsKnownOfIt) {
  EXPECT_EQ(
      drive.show("0x6065").value().text,
      "0x6065:00 Max Following Error = 2000 (0x000007D0) position units  [UNSIGNED32, rw, default 2000]");
  EXPECT_EQ(without_sheet.show("0x1018:4").value().text, "0x1018:04 Serial Number = 7 (0x00000007)");
  EXPECT_EQ(without_sheet.show("0x1008").value().text.substr(0, 9), "0x1008:00");
  EXPECT_TRUE(contains(drive.show("0x1008").value().text, "\"EPOS2\""));
}

TEST_F(CanDriveTest, AbortsAreToldInWords) {
  EXPECT_EQ(without_sheet.show("0x7FFF").error(),
            "0x7FFF:00: node 3 refuses the read: object does not exist (SDO abort 0x06020000)");
  EXPECT_TRUE(contains(without_sheet.show("0x60C4:6").error(), "SDO abort 0x06010001"));  // write-only
  CanDrive nobody(session, 9, std::nullopt);
  EXPECT_TRUE(contains(nobody.show("0x6064").error(), "node 9 does not answer. Check its power"));
}

TEST_F(CanDriveTest, AWriteShowsWhatItChangesAndIsReadBack) {
  const Change change = drive.prepare("Max Following Error", "4000").value();
  EXPECT_EQ(change.text(), "0x6065:00 Max Following Error: 2000 -> 4000 position units");
  EXPECT_EQ(writes(), 0U);
  EXPECT_EQ(drive.apply(change), std::nullopt);
  EXPECT_EQ(writes(), 1U);
  EXPECT_TRUE(contains(drive.show("0x6065").value().text, "= 4000 "));
  EXPECT_EQ(written("0x607D:1", "-5000", without_sheet), "");
  EXPECT_TRUE(contains(drive.show("0x607D:1").value().text, "= -5000 position units"));
}

TEST_F(CanDriveTest, WhatCannotBeWrittenIsASentenceAndNothingIsSent) {
  EXPECT_TRUE(contains(written("0x6064", "1", drive), "0x6064:00 Position Actual Value is read-only"));
  EXPECT_TRUE(contains(written("0x607F", "25001", drive), "allowed: a whole number within 0..25000"));
  EXPECT_TRUE(contains(written("0x6061", "400", without_sheet), "within -128..255"));
  EXPECT_EQ(writes(), 0U);
}

TEST_F(CanDriveTest, WhatTheDriveRefusesIsToldInItsWords) {
  EXPECT_TRUE(contains(written("0x6064", "1", without_sheet), "node 3 refuses the write: "));
  EXPECT_TRUE(contains(written("0x6064", "1", without_sheet), "SDO abort 0x06010002"));
  EXPECT_TRUE(contains(written("0x607F", "25001", without_sheet), "SDO abort 0x0609003"));
}

// CiA 301, 1010h: "save".
TEST_F(CanDriveTest, SavedParametersOutliveThePower) {
  ASSERT_EQ(written("0x6065", "4000", drive), "");
  epos.power_cycle(world.now(), std::chrono::milliseconds(100));
  session.listen(std::chrono::milliseconds(500));
  EXPECT_TRUE(contains(drive.show("0x6065").value().text, "= 2000 "));
  ASSERT_EQ(written("0x6065", "4000", drive), "");
  EXPECT_EQ(drive.save(), std::nullopt);
  epos.power_cycle(world.now(), std::chrono::milliseconds(100));
  session.listen(std::chrono::milliseconds(500));
  EXPECT_TRUE(contains(drive.show("0x6065").value().text, "= 4000 "));
}

TEST_F(CanDriveTest, ParametersAreWhatCanBeWrittenAndKept) {
  const auto found = drive.parameters({}).value();
  std::string numbers;
  for (const Parameter& parameter : found) numbers += parameter.number + " ";
  for (const char* number : {"0x1017:00", "0x1400:01", "0x1600:08", "0x6065:00", "0x607D:02", "0x6410:05"})
    EXPECT_TRUE(contains(numbers, number)) << number;
  // Process values, commands, setpoints, histories.
  for (const char* number : {"0x6064", "0x6040", "0x607A", "0x1003", "0x1010", "0x20C1", "0x1018"})
    EXPECT_FALSE(contains(numbers, number)) << number;
  EXPECT_TRUE(contains(without_sheet.parameters({}).error(), "--eds FILE"));
}

TEST_F(CanDriveTest, ADumpIsRestoredToTheLastMapping) {
  const auto wanted = drive.parameters({}).value();
  ASSERT_EQ(drive.differences(wanted, {}).value().size(), 0U);
  ASSERT_EQ(written("0x6065", "4000", drive), "");
  // Another mapping of RPDO 1, with the PDO switched off meanwhile.
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, const char*>>{{"0x1400:1", "0x80000203"},
                                                        {"0x1600:0", "0"},
                                                        {"0x1600:1", "0x60600008"},
                                                        {"0x1600:2", "0x60400010"},
                                                        {"0x1600:0", "2"},
                                                        {"0x1400:2", "1"},
                                                        {"0x1400:1", "0x203"}})
    ASSERT_EQ(written(name, value, drive), "") << name;
  const auto changes = drive.differences(wanted, {}).value();
  ASSERT_EQ(changes.size(), 5U);  // 0x1400:2, 0x1600:0 to :2, 0x6065
  EXPECT_EQ(drive.why_not_restore(), std::nullopt);
  EXPECT_TRUE(drive.restore(wanted, changes).empty());
  EXPECT_TRUE(drive.differences(wanted, {}).value().empty());
}

TEST_F(CanDriveTest, AFileWithAValueThatDoesNotFitIsRefused) {
  const auto refused = drive.differences({{"0x6065:00", "UNSIGNED32", "99999999999999999999", ""}}, {});
  ASSERT_FALSE(refused);
  EXPECT_TRUE(contains(refused.error(), "is no number; allowed: a whole number within 0..4294967295"));
  EXPECT_TRUE(
      contains(drive.differences({{"0x16065:00", "UNSIGNED32", "1", ""}}, {}).error(), "no object's number"));
}

TEST_F(CanDriveTest, AnEnabledDriveIsNotRestored) {
  for (const char* word : {"6", "15"}) ASSERT_EQ(written("0x6040", word, drive), "");
  session.listen(std::chrono::milliseconds(50));
  ASSERT_NE(drive.why_not_restore(), std::nullopt);
  EXPECT_TRUE(contains(*drive.why_not_restore(), "node 3 is enabled (operation enabled"));
}

TEST_F(CanDriveTest, TellsWhichDriveItIs) {
  const DriveIdentity identity = drive.identity().value();
  EXPECT_EQ(identity, (DriveIdentity{{"kind", "canopen"},
                                     {"vendor", "0x000000FB"},
                                     {"product", "0x64200000"},
                                     {"revision", "0x21260000"},
                                     {"serial", "0x00000007"},
                                     {"node", "3"}}));
}

TEST_F(CanDriveTest, ADriveThatFallsSilentEndsADumpSoon) {
  epos.silence(true, world.now());
  const HostTime begin = world.now();
  EXPECT_TRUE(contains(drive.parameters({}).error(), "does not answer"));
  EXPECT_LT(seconds(world.now() - begin), 2.0);
}

}  // namespace
}  // namespace interpolated_motion::commissioning
