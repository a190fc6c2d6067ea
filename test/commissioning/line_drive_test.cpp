#include "interpolated_motion_driver/commissioning/line_drive.h"

#include <gtest/gtest.h>

#include "bench.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

namespace interpolated_motion::commissioning {
namespace {

using emulation::SilverDust;
using emulation::SilverDustParameters;

struct LineDriveTest : testing::Test, LineBench {
  LineDriveTest() {
    SilverDustParameters parameters;
    parameters.initial_position = -4000;
    world.add<SilverDust>(line, parameters);
  }

  LineDrive drive{session, 16};
};

TEST_F(LineDriveTest, ARegisterIsShownByNumberAndByName) {
  const std::string text = "register 1 actual_position = -4000 (0xFFFFF060) counts  [INTEGER32, ro]";
  EXPECT_EQ(drive.show("1").value().text, text);
  EXPECT_EQ(drive.show("actual_position").value().text, text);
  EXPECT_TRUE(contains(drive.show("actual_positon").error(), "did you mean actual_position?"));
  EXPECT_TRUE(contains(drive.show("300").error(), "is no register: they have numbers 0..255"));
}

TEST_F(LineDriveTest, AWriteShowsWhatItChangesAndIsReadBack) {
  const Change change = drive.prepare("19", "1000").value();
  EXPECT_EQ(change.text(), "register 19 ims_deceleration: 0 -> 1000 2000 rpm per tick / 2^31");
  EXPECT_EQ(drive.apply(change), std::nullopt);
  EXPECT_TRUE(contains(drive.show("19").value().text, "= 1000 "));
}

TEST_F(LineDriveTest, WhatCannotBeWrittenIsASentence) {
  EXPECT_TRUE(contains(drive.prepare("1", "0").error(), "register 1 actual_position is read-only"));
  EXPECT_TRUE(contains(drive.prepare("30", "2147483648").error(),
                       "is no whole number within -2147483648..2147483647"));
  EXPECT_TRUE(contains(drive.save().value_or(""), "keeps no registers without power"));
  LineDrive nobody(session, 40);
  EXPECT_TRUE(contains(nobody.show("1").error(), "address 40 does not answer"));
}

TEST_F(LineDriveTest, ADumpIsRestored) {
  const auto wanted = drive.parameters({}).value();
  EXPECT_GT(wanted.size(), 200U);
  ASSERT_EQ(drive.apply(drive.prepare("100", "-7").value()), std::nullopt);
  const auto changes = drive.differences(wanted, {}).value();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].text(), "register 100: -7 -> 0");
  EXPECT_EQ(drive.why_not_restore(), std::nullopt);
  EXPECT_TRUE(drive.restore(wanted, changes).empty());
  EXPECT_TRUE(drive.differences(wanted, {}).value().empty());
}

TEST_F(LineDriveTest, TellsWhichDriveItIs) {
  EXPECT_EQ(drive.identity().value(),
            (DriveIdentity{{"kind", "silverlode"}, {"revision", "31"}, {"address", "16"}}));
}

}  // namespace
}  // namespace interpolated_motion::commissioning
