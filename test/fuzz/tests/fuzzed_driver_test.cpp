#include "fuzz/support/fuzzed_driver.h"

#include <gtest/gtest.h>

#include "fuzz/support/arms.h"
#include "fuzz/support/foreign_node.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr double kCount = 1e-4;  // rad, more than 3 counts of 2000 * 100 a turn

class FuzzedArm : public testing::TestWithParam<const char*> {
 protected:
  FuzzedDriver arm_{arm_of(GetParam())};
};

// What nobody brings up and moves, no input can harm.
TEST_P(FuzzedArm, MovesWithinItsLimits) {
  arm_.hold_limits();
  arm_.bring_up();
  ASSERT_EQ(arm_.snapshot().state, motion::GroupState::Idle) << arm_.snapshot().fault;
  arm_.move(0.02, 0.3);
  ASSERT_EQ(arm_.open_goals().size(), 1U);
  arm_.run(3.0);
  EXPECT_TRUE(arm_.open_goals().empty());
  for (const double position : arm_.positions()) EXPECT_NEAR(position, 0.02, kCount);
  arm_.finish();
}

INSTANTIATE_TEST_SUITE_P(Arms, FuzzedArm, testing::Values("e", "c", "s", "ee", "ec", "ss", "es", "ecs"));

TEST(FuzzedDriver, GivesTheBusOfItsDrives) {
  FuzzedDriver arm(arm_of("e"));
  arm.bring_up();
  ForeignNode node(*arm.buses().can);
  canopen::Frame emergency;
  emergency.id = 0x081;
  emergency.length = 8;
  emergency.data = {0x10, 0x32, 0x05};
  ASSERT_TRUE(node.send(emergency, arm.now()));
  arm.run(0.1);
  EXPECT_EQ(arm.snapshot().joints.front().error_code, 0x3210);
}

TEST(FuzzInputTest, ReadsWhatItIsGivenAndThenZeros) {
  const std::uint8_t bytes[] = {0x34, 0x12, 64, 0xE8, 0x03, 'a', 'b', '\n', 'c'};
  FuzzInput input(bytes, sizeof bytes);
  EXPECT_EQ(input.word(), 0x1234);
  EXPECT_EQ(input.number(), 1.0);
  EXPECT_EQ(input.line(10), "ab");
  EXPECT_EQ(input.rest(), "c");
  EXPECT_TRUE(input.empty());
  EXPECT_EQ(input.byte(), 0);
}

TEST(FuzzInputTest, ReadsAnExtendedFrame) {
  const std::uint8_t bytes[] = {0x81, 0x11, 0x01, 0x00, 2, 0xAA, 0x55};
  FuzzInput input(bytes, sizeof bytes);
  const canopen::Frame frame = read_frame(input);
  EXPECT_TRUE(frame.extended);
  EXPECT_EQ(frame.id, 0x800U | 0x181U);
  EXPECT_EQ(frame.length, 2);
  EXPECT_EQ(frame.data[1], 0x55);
}

}  // namespace
}  // namespace interpolated_motion::fuzz
