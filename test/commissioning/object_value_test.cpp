#include "interpolated_motion_driver/commissioning/object_value.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace interpolated_motion::commissioning {
namespace {

using canopen::DataType;
using canopen::ObjectAddress;

canopen::Eds sheet() {
  return canopen::parse_eds(
      "[6065]\nParameterName=Max Following Error\nDataType=7\nAccessType=rw\nDefaultValue=2000\nLowLimit=10\n"
      "HighLimit=4000\n"
      "[60C0]\nParameterName=Sub Mode\nDataType=3\nAccessType=rw\n"
      "[1016]\nParameterName=Consumer\nSubNumber=2\n"
      "[1016sub1]\nParameterName=Time\nDataType=7\nAccessType=rw\n"
      "[1016sub2]\nParameterName=Time\nDataType=7\nAccessType=rw\n",
      1);
}

std::string refusal(const std::string& name, const std::string& value, std::size_t size = 4) {
  const canopen::Eds eds = sheet();
  const auto bytes = value_bytes(value, find_object(name, &eds).value(), size);
  return bytes ? "" : bytes.error();
}

TEST(ObjectValue, AnObjectIsFoundByItsNumber) {
  for (const char* text : {"0x1018:4", "1018h:4", "1018:04", "0x1018:0x04"}) {
    const auto found = find_object(text, nullptr);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(found.value().address, (ObjectAddress{0x1018, 4})) << text;
    EXPECT_EQ(title(found.value()), "0x1018:04 Serial Number");
  }
  EXPECT_EQ(find_object("0x6064", nullptr).value().address, (ObjectAddress{0x6064, 0}));
}

TEST(ObjectValue, WhatIsNoObjectIsASentence) {
  const canopen::Eds eds = sheet();
  EXPECT_TRUE(contains(find_object("0x16064", nullptr).error(), "names are looked up in an EDS: --eds FILE"));
  EXPECT_TRUE(
      contains(find_object("Max Folowing Error", &eds).error(), "did you mean \"Max Following Error\"?"));
  EXPECT_TRUE(
      contains(find_object("Time", &eds).error(),
               "is the name of 2 objects, take one of their numbers: 0x1016:01 Consumer / Time, 0x1016:02"));
  EXPECT_EQ(find_object("max following error", &eds).value().address, (ObjectAddress{0x6065, 0}));
}

TEST(ObjectValue, AValueIsWrittenLeastSignificantByteFirst) {
  const canopen::Eds eds = sheet();
  EXPECT_EQ(value_bytes("0x0123", find_object("0x6065", &eds).value(), 0).value(),
            (std::vector<std::uint8_t>{0x23, 0x01, 0, 0}));
  EXPECT_EQ(value_bytes("-2", find_object("0x60C0", &eds).value(), 0).value(),
            (std::vector<std::uint8_t>{0xFE, 0xFF}));
  // Without an EDS the width is that of the object as it was read, with or without a sign.
  EXPECT_EQ(value_bytes("255", find_object("0x60C0", nullptr).value(), 1).value(),
            (std::vector<std::uint8_t>{0xFF}));
  EXPECT_EQ(value_bytes("-1", find_object("0x60C0", nullptr).value(), 1).value(),
            (std::vector<std::uint8_t>{0xFF}));
}

TEST(ObjectValue, AValueOutOfRangeIsASentence) {
  EXPECT_TRUE(contains(refusal("0x6065", "5000"),
                       "\"5000\" is out of range; allowed: a whole number within 10..4000"));
  EXPECT_TRUE(contains(refusal("0x6065", "9"), "out of range"));
  EXPECT_TRUE(contains(refusal("0x60C0", "40000"), "within -32768..32767"));
  EXPECT_TRUE(contains(refusal("0x60C0", "fast"), "\"fast\" is no number"));
  EXPECT_TRUE(contains(refusal("0x60C0", "1e3"), "no number"));
  EXPECT_TRUE(contains(refusal("0x60C0", "99999999999999999999"), "no number"));
  EXPECT_TRUE(contains(refusal("0x7000", "256", 1), "within -128..255"));
}

TEST(ObjectValue, WhatTheSheetSaysIsShown) {
  const canopen::Eds eds = sheet();
  EXPECT_EQ(facts_text(find_object("0x6065", &eds).value()), "UNSIGNED32, rw, default 2000, range 10..4000");
  EXPECT_EQ(unit_of({0x6064, 0}), "position units");
  EXPECT_EQ(unit_of({0x607D, 0}), "");
  EXPECT_EQ(unit_of({0x6041, 0}), "");
}

}  // namespace
}  // namespace interpolated_motion::commissioning
