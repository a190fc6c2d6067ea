#include "interpolated_motion_driver/protocol/canopen/eds.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace interpolated_motion::canopen {
namespace {

constexpr const char* kText =
    "; a comment\r\n"
    "[DeviceInfo]\r\n"
    "ProductName=Drive\r\n"
    "VendorNumber=0x000000FB\r\n"
    "[6065]\r\n"
    "ParameterName=Max Following Error\r\n"
    "ObjectType=0x7\r\n"
    "DataType=0x0007\r\n"
    "AccessType=rww\r\n"
    "DefaultValue=2000\r\n"
    "LowLimit=0x10\r\n"
    "HighLimit=4000\r\n"
    "[1018]\r\n"
    "ParameterName=Identity\r\n"
    "ObjectType=0x9\r\n"
    "SubNumber=2\r\n"
    "[1018SUB4]\r\n"
    "PARAMETERNAME=Serial Number\r\n"
    "DataType=7\r\n"
    "AccessType=ro\r\n"
    "[60C0]\r\n"
    "ParameterName=Interpolation Sub Mode Selection\r\n"
    "DataType=0x0003\r\n"
    "AccessType=rw\r\n"
    "DefaultValue=0xFFFF\r\n"
    "[1014]\r\n"
    "ParameterName=COB-ID EMCY\r\n"
    "DataType=0x0007\r\n"
    "AccessType=const\r\n"
    "DefaultValue=$NODEID+0x80\r\n"
    "[2000]\r\n"
    "ParameterName=Gains\r\n"
    "ObjectType=0x8\r\n"
    "DataType=0x0006\r\n"
    "AccessType=rw\r\n"
    "CompactSubObj=3\r\n";

std::string refusal(const std::string& text) {
  try {
    parse_eds(text, 1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Eds, TellsTypeAccessDefaultAndRange) {
  const Eds eds = parse_eds(kText, 5);
  EXPECT_EQ(eds.vendor, 0xFBU);
  EXPECT_EQ(eds.product_name, "Drive");
  const EdsObject* error = eds.find(ObjectAddress{0x6065, 0});
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->full_name(), "Max Following Error");
  EXPECT_EQ(error->type, DataType::Unsigned32);
  EXPECT_EQ(error->access, ObjectAccess::ReadWrite);
  EXPECT_EQ(error->default_value, 2000);
  EXPECT_EQ(error->low, 16);
  EXPECT_EQ(error->high, 4000);
  EXPECT_EQ(eds.find(ObjectAddress{0x6064, 0}), nullptr);
}

// CiA 306: neither sections nor keys depend on the case; the head of a record is no object.
TEST(Eds, EntriesOfARecordHaveItsName) {
  const Eds eds = parse_eds(kText, 5);
  EXPECT_EQ(eds.find(ObjectAddress{0x1018, 0}), nullptr);
  const EdsObject* serial = eds.find(ObjectAddress{0x1018, 4});
  ASSERT_NE(serial, nullptr);
  EXPECT_EQ(serial->full_name(), "Identity / Serial Number");
  EXPECT_EQ(serial->access, ObjectAccess::ReadOnly);
}

TEST(Eds, NumbersAreReadWithTheSignOfTheirTypeAndWithTheNodeId) {
  const Eds eds = parse_eds(kText, 5);
  EXPECT_EQ(eds.find(ObjectAddress{0x60C0, 0})->default_value, -1);
  const EdsObject* emcy = eds.find(ObjectAddress{0x1014, 0});
  EXPECT_EQ(emcy->default_value, 0x85);
  EXPECT_TRUE(emcy->constant);
  EXPECT_EQ(emcy->access, ObjectAccess::ReadOnly);
}

TEST(Eds, ACompactArrayHasAllItsEntries) {
  const Eds eds = parse_eds(kText, 5);
  EXPECT_EQ(eds.find(ObjectAddress{0x2000, 0})->type, DataType::Unsigned8);
  EXPECT_EQ(eds.find(ObjectAddress{0x2000, 3})->type, DataType::Unsigned16);
  EXPECT_EQ(eds.find(ObjectAddress{0x2000, 4}), nullptr);
}

TEST(Eds, ANameIsFoundWhateverItsCase) {
  const Eds eds = parse_eds(kText, 5);
  ASSERT_EQ(eds.find("max following error").size(), 1U);
  ASSERT_EQ(eds.find("Identity / Serial Number").size(), 1U);
  EXPECT_TRUE(eds.find("Serial").empty());
}

TEST(Eds, WhatCannotBeReadIsToldWithItsPlace) {
  EXPECT_NE(refusal("not an EDS\n").find("line 1 is \"not an EDS\""), std::string::npos);
  EXPECT_NE(refusal("[6064]\nDataType=four\n").find("[6064] datatype is \"four\""), std::string::npos);
  EXPECT_NE(refusal("[6064]\nDataType=4\nLowLimit=1x\n").find("lowlimit is \"1x\""), std::string::npos);
  EXPECT_NE(refusal("").find("describes no object"), std::string::npos);
}

TEST(Eds, TheSheetsOfTheEmulatedDrivesAreRead) {
  for (const char* name : {"epos2_emulated.eds", "cyclic_emulated.eds"}) {
    std::ifstream file(std::string(IMD_SOURCE_DIR) + "/config/eds/" + name);
    std::stringstream text;
    text << file.rdbuf();
    const Eds eds = parse_eds(text.str(), 1);
    EXPECT_GT(eds.objects.size(), 100U) << name;
    EXPECT_EQ(eds.find(ObjectAddress{0x6041, 0})->type, DataType::Unsigned16);
  }
}

}  // namespace
}  // namespace interpolated_motion::canopen
