#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "protocol/allocation_count.h"
#include "protocol/canopen/bytes.h"

namespace interpolated_motion::canopen::test {
namespace {

TEST(MasterAllocation, NoneForAFrame) {
  MasterParameters parameters;
  parameters.sync_period = std::chrono::milliseconds(10);
  parameters.time_stamp_period = 1;
  parameters.heartbeat_period = std::chrono::milliseconds(10);
  parameters.heartbeat_timeout = std::chrono::milliseconds(50);
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  int pdos = 0;
  node.set_tpdo_handler([&pdos](int, const Frame&, HostTime) { ++pdos; });
  const std::uint8_t data[8] = {};
  int transfers = 0;
  int sent = 0;

  const std::size_t before = interpolated_motion::test::allocation_count();
  for (int ms = 0; ms < 1000; ++ms) {
    const HostTime now = at_ms(ms);
    master.on_frame({make_frame(0x080, {}), now, true});
    master.on_frame({make_frame(0x183, {0x37, 0x13}), now, false});
    master.on_frame({make_frame(0x083, {0x0C, 0xFF, 0x20, 0, 0, 0, 0, 0}), now, false});
    master.on_frame({make_frame(0x703, {0x05}), now, false});
    master.on_frame({make_frame(0x799, {0x05}), now, false});
    master.on_frame({make_frame(0x583, {0x4B, 0x41, 0x60, 0, 0x37, 0x13, 0, 0}), now, false});
    if (const auto result = node.sdo().take_result()) transfers += result->ok ? 1 : 0;
    node.sdo().start_upload({0x6041, 0}, now);
    node.send_rpdo(2, data, 3);
    node.send_record(1, data, 8);
    master.poll(now);
    while (master.peek_outgoing(now) != nullptr) {
      master.pop_outgoing(now);
      ++sent;
    }
  }
  EXPECT_EQ(interpolated_motion::test::allocation_count() - before, 0u);
  EXPECT_EQ(pdos, 1000);
  EXPECT_EQ(transfers, 999);
  EXPECT_GT(sent, 3000);
  EXPECT_GT(master.time_stamps_sent(), 90u);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
