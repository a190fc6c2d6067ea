#include "interpolated_motion_driver/protocol/silverlode/register_table.h"

#include <gtest/gtest.h>

namespace interpolated_motion::silverlode {
namespace {

TEST(RegisterTable, ARegisterIsFoundByNumberAndByName) {
  EXPECT_EQ(find_register("1"), 1);
  EXPECT_EQ(find_register("actual_position"), 1);
  EXPECT_EQ(find_register("255"), 255);
  EXPECT_EQ(find_register("256"), std::nullopt);
  EXPECT_EQ(find_register("-1"), std::nullopt);
  EXPECT_EQ(find_register(""), std::nullopt);
  EXPECT_EQ(find_register("actual_positon"), std::nullopt);
  EXPECT_EQ(closest_register("actual_positon"), "actual_position");
}

// QCI-TD044: "The following registers are used": 17, 18 and 19; 18 must not be written.
TEST(RegisterTable, WhatAHostMayWriteIsKnown) {
  EXPECT_TRUE(register_facts(19).writable);
  EXPECT_FALSE(register_facts(18).writable);
  EXPECT_FALSE(register_facts(1).writable);
  EXPECT_FALSE(register_facts(20).parameter);  // of the profile that runs
  EXPECT_TRUE(register_facts(100).parameter);  // the user's
  EXPECT_STREQ(register_facts(100).name, "");
}

}  // namespace
}  // namespace interpolated_motion::silverlode
