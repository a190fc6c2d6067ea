#include "interpolated_motion_driver/commissioning/parameter_file.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "bench.h"

namespace interpolated_motion::commissioning {
namespace {

const DriveIdentity kDrive{{"kind", "canopen"},
                           {"vendor", "0x000000FB"},
                           {"product", "0x64200000"},
                           {"revision", "0x21260000"},
                           {"serial", "0x00000001"}};

DriveIdentity with(const char* name, const char* value) {
  DriveIdentity identity = kDrive;
  for (auto& entry : identity)
    if (entry.first == name) entry.second = value;
  return identity;
}

std::string refusal(const std::string& text) {
  try {
    parse_parameter_file(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ParameterFile, ComesBackAsItWasWritten) {
  const ParameterFile file{
      kDrive, {{"0x6065:00", "UNSIGNED32", "2000", "Max Following Error"}, {"19", "INTEGER32", "-5", ""}}};
  const std::string text = to_text(file);
  EXPECT_TRUE(contains(text, "# drive_tool parameters, format 1\nkind: canopen\nvendor: 0x000000FB\n"))
      << text;
  const ParameterFile again = parse_parameter_file(text);
  EXPECT_EQ(again.identity, file.identity);
  ASSERT_EQ(again.parameters.size(), 2U);
  EXPECT_EQ(again.parameters[0].number, "0x6065:00");
  EXPECT_EQ(again.parameters[0].type, "UNSIGNED32");
  EXPECT_EQ(again.parameters[0].value, "2000");
  EXPECT_EQ(again.parameters[0].name, "Max Following Error");
  EXPECT_EQ(again.parameters[1].value, "-5");
}

TEST(ParameterFile, WhatIsNoneIsToldWithItsLine) {
  EXPECT_TRUE(contains(refusal("joints: [a]\n"), "line 1 is \"joints: [a]\": no file of drive_tool dump"));
  const std::string head = std::string(kParameterFileHeader) + "\nkind: canopen\n";
  EXPECT_TRUE(contains(refusal(head + "0x6065:00 UNSIGNED32\n"), "line 3 is \"0x6065:00 UNSIGNED32\""));
  EXPECT_TRUE(contains(refusal(head + "0x6065:00 UNSIGNED32 1 2\n"), "NUMBER TYPE VALUE"));
  EXPECT_TRUE(contains(refusal(head + "0x6065:00 UNSIGNED32 fast\n"), "VALUE a decimal number"));
  EXPECT_TRUE(contains(refusal(head + "0x6065:00 FLOAT 1\n"), "TYPE is such as UNSIGNED32"));
  EXPECT_TRUE(contains(refusal(head), "it has been cut off"));
  EXPECT_TRUE(contains(refusal(""), "cut off"));
}

TEST(ParameterFile, AnotherDriveIsRefused) {
  EXPECT_EQ(why_another_drive(kDrive, kDrive, false), "");
  EXPECT_EQ(why_another_drive(kDrive, with("serial", "0x00000002"), false),
            "the file is of another drive: serial is 0x00000001 in the file and 0x00000002 in the drive. "
            "Where this "
            "drive takes the place of that one: --replacement");
  EXPECT_EQ(why_another_drive(kDrive, with("serial", "0x00000002"), true), "");
  const std::string other = why_another_drive(kDrive, with("product", "0x63220000"), true);
  EXPECT_TRUE(contains(other, "product is 0x64200000 in the file and 0x63220000 in the drive"));
  EXPECT_FALSE(contains(other, "--replacement"));
  EXPECT_TRUE(
      contains(why_another_drive({{"kind", "silverlode"}}, kDrive, true), "kind is silverlode in the file"));
}

}  // namespace
}  // namespace interpolated_motion::commissioning
