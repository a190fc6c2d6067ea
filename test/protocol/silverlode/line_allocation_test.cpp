#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "protocol/allocation_count.h"

namespace interpolated_motion::silverlode::test {
namespace {

void receive(LineMaster& master, const char* text, HostTime time) {
  for (; *text != '\0'; ++text) master.on_character(*text, time);
}

// Control and bulk requests, replies of every kind, repeats, garbage, late replies, load.
TEST(LineAllocation, NoneForAnExchange) {
  static const char* const replies[] = {
      "* 10\r", "* 1x\r", "! 10 0019 0006\r", "# 10 000C 0001 6760\r", "late garbage\r", "* 11\r",
      "",       "* 10\r"};
  LineMaster master("line0");
  DeviceLink& drive = master.add_device(16);
  int outcomes = 0;
  double load = 0;

  const std::size_t before = interpolated_motion::test::allocation_count();
  for (int i = 0; i < 4000; ++i) {
    const HostTime now{std::chrono::milliseconds(10 * i)};
    drive.request(rrg_request(16, 1));
    if (i % 3 == 0) drive.request(wri_request(16, 17, 0));
    drive.offer_bulk(imw_request(16, i, 1073741824, 1073742, 536870912), now);
    master.poll(now);
    if (master.peek_outgoing(now)) master.pop_outgoing(now);
    receive(master, replies[i % 8], now);
    load += master.load(now);
    while (drive.take_outcome()) ++outcomes;
  }
  EXPECT_EQ(interpolated_motion::test::allocation_count() - before, 0u);
  EXPECT_GT(outcomes, 500);
  EXPECT_GT(load, 0);
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
