#include <gtest/gtest.h>

#include "interpolated_motion_driver/transport/can_frame_text.h"

namespace interpolated_motion::transport {
namespace {

TEST(CanFrameText, IsReadAsCandumpWritesIt) {
  const auto nmt = parse_frame("000#8002");
  ASSERT_TRUE(nmt);
  EXPECT_EQ(nmt->id, 0u);
  EXPECT_EQ(nmt->length, 2);
  EXPECT_EQ(nmt->data[0], 0x80);
  EXPECT_EQ(nmt->data[1], 0x02);
  EXPECT_FALSE(nmt->extended || nmt->remote);
  EXPECT_EQ(parse_frame("7ff#")->length, 0);
  EXPECT_TRUE(parse_frame("189#R")->remote);
  EXPECT_TRUE(parse_frame("1FFFFFFF#0011223344556677")->extended);
}

TEST(CanFrameText, IsRefusedWhereItIsNone) {
  for (const char* text : {"", "#", "80#", "800#", "0000#", "20000000#", "000", "000#1", "000#1G", "0x0#12",
                           "000#001122334455667788", " 00#", "000# 1", "000#R1"})
    EXPECT_FALSE(parse_frame(text)) << text;
}

}  // namespace
}  // namespace interpolated_motion::transport
