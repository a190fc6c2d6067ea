#include "interpolated_motion_driver/protocol/canopen/master.h"

#include <gtest/gtest.h>

#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"

// What the master sends, in which order and when.
namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::milliseconds;

TEST(MasterSending, ControlFramesLeaveInTheOrderMadeAndBeforeBulkFrames) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  const std::uint8_t enable[] = {0x1F, 0x00, 0x07};
  ASSERT_TRUE(node.send_record(1, kData, 8));
  ASSERT_TRUE(node.send_nmt(NmtCommand::Start));
  ASSERT_TRUE(node.send_rpdo(2, enable, 3));
  ASSERT_TRUE(node.sdo().start_upload({0x6041, 0}, at_ms(0)));
  ASSERT_TRUE(master.request_sync(at_ms(0)));
  ASSERT_TRUE(master.send_nmt(NmtCommand::Stop, kAllNodes));
  EXPECT_EQ(drain(master, at_ms(0)), (Texts{"000#0103", "303#1F0007", "603#4041600000000000", "080#",
                                            "000#0200", "203#0102030405060708"}));
}

TEST(MasterSending, AFrameStaysUntilItIsTaken) {
  Master master("can0");
  master.add_node(3).send_record(1, kData, 8);
  const Frame first = *master.peek_outgoing(at_ms(0));
  EXPECT_EQ(*master.peek_outgoing(at_ms(1)), first);
  master.send_nmt(NmtCommand::Start, 3);
  EXPECT_EQ(to_string(*master.peek_outgoing(at_ms(2))), "000#0103");
  master.pop_outgoing(at_ms(2));
  EXPECT_EQ(*master.peek_outgoing(at_ms(2)), first);
  EXPECT_EQ(master.find_node(3)->pending_records(), 1u);
}

TEST(MasterSending, BulkFramesArePacedToTheirShareOfTheBus) {
  MasterParameters parameters;  // 1 Mbit/s, 0.6: 135 bits / 600 kbit/s = 225 us for a frame
  parameters.bulk_burst = 4;
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(node.send_record(1, kData, 8));
  const HostTime t0 = at_ms(1000);
  EXPECT_EQ(drain(master, t0).size(), 4u);
  EXPECT_EQ(node.pending_records(), 6u);
  EXPECT_EQ(master.next_deadline(), t0 + std::chrono::microseconds(225));
  EXPECT_EQ(drain(master, t0 + std::chrono::microseconds(224)).size(), 0u);
  EXPECT_EQ(drain(master, t0 + std::chrono::microseconds(225)).size(), 1u);
  EXPECT_EQ(master.next_deadline(), t0 + std::chrono::microseconds(450));
  EXPECT_EQ(drain(master, t0 + std::chrono::microseconds(1125)).size(), 4u);
  master.send_nmt(NmtCommand::Start, 3);
  EXPECT_EQ(drain(master, t0 + std::chrono::microseconds(1125)).size(), 1u);  // control frames are not paced
  EXPECT_EQ(drain(master, t0 + std::chrono::microseconds(1350)).size(), 1u);
  EXPECT_EQ(node.pending_records(), 0u);
  EXPECT_EQ(master.next_deadline(), kNever);
}

TEST(MasterSending, FramesThatMayGoSetNoDeadline) {
  Master master("can0");
  master.poll(at_ms(1000));
  master.add_node(3).send_record(1, kData, 8);
  master.send_nmt(NmtCommand::Start, 3);
  EXPECT_EQ(master.next_deadline(), kNever);
}

TEST(MasterSending, PacingFollowsBitRateAndShare) {
  MasterParameters parameters;
  parameters.bitrate = 125'000;
  parameters.max_bulk_load = 0.5;
  parameters.bulk_burst = 1;
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(node.send_record(1, kData, 8));
  // 135 / 62500 s = 2.16 ms: at 0, 2.16, ..., 99.36 ms go 47 frames within 100 ms.
  int sent = 0;
  for (int us = 0; us < 100'000; us += 20) sent += static_cast<int>(drain(master, at_us(us)).size());
  EXPECT_EQ(sent, 47);
}

TEST(MasterSending, BulkFramesOfNodesTakeTurns) {
  MasterParameters parameters;
  parameters.bulk_burst = 64;
  Master master("can0", parameters);
  NodeLink& a = master.add_node(1);
  NodeLink& b = master.add_node(2);
  NodeLink& c = master.add_node(3);
  const auto record = [](NodeLink& node, std::uint8_t value) { node.send_record(1, &value, 1); };
  for (std::uint8_t i = 1; i <= 3; ++i) record(a, i);
  record(b, 1);
  record(c, 1);
  record(c, 2);
  EXPECT_EQ(drain(master, at_ms(1)), (Texts{"201#01", "202#01", "203#01", "201#02", "203#02", "201#03"}));
}

TEST(MasterSending, BulkQueueIsBoundedVisibleAndCanBeDropped) {
  MasterParameters parameters;
  parameters.bulk_capacity = 3;
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(node.send_record(1, kData, 8));
  EXPECT_FALSE(node.send_record(1, kData, 8));
  EXPECT_EQ(node.pending_records(), 3u);
  EXPECT_EQ(node.record_capacity(), 3u);
  node.clear_records();
  EXPECT_EQ(node.pending_records(), 0u);
  EXPECT_TRUE(drain(master, at_ms(0)).empty());
}

TEST(MasterSending, FullControlQueueRefusesAndCounts) {
  MasterParameters parameters;
  parameters.control_capacity = 16;
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  for (int i = 0; i < 16; ++i) EXPECT_TRUE(node.send_rpdo(2, kData, 2));
  EXPECT_FALSE(node.send_rpdo(2, kData, 2));
  EXPECT_FALSE(master.request_sync(at_ms(0)));
  EXPECT_EQ(master.control_overflows(), 2u);
  EXPECT_EQ(master.pending_control(), 16u);
  // An SDO request waits in its client until there is room.
  node.sdo().start_upload({0x6041, 0}, at_ms(0));
  const Texts sent = drain(master, at_ms(0));
  ASSERT_EQ(sent.size(), 17u);
  EXPECT_EQ(sent.back(), "603#4041600000000000");
}

TEST(MasterSending, InvalidPdosAreRefused) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  EXPECT_FALSE(node.send_rpdo(0, kData, 2));
  EXPECT_FALSE(node.send_rpdo(5, kData, 2));
  EXPECT_FALSE(node.send_rpdo(1, kData, 9));
  EXPECT_FALSE(node.send_record(5, kData, 8));
  EXPECT_EQ(master.peek_outgoing(at_ms(0)), nullptr);
}

TEST(MasterSending, ClearedFramesNeverLeave) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  node.send_rpdo(2, kData, 2);
  node.send_record(1, kData, 8);
  node.sdo().start_upload({0x6041, 0}, at_ms(0));
  master.clear_outgoing();
  EXPECT_TRUE(drain(master, at_ms(0)).empty());
  master.poll(at_ms(250));
  EXPECT_EQ(node.sdo().take_result()->abort_code, 0x05040000u);
  EXPECT_EQ(drain(master, at_ms(250)), (Texts{"603#8041600000000405"}));
}

TEST(MasterSending, SegmentsOfABlockLetOtherControlFramesThrough) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  node.sdo().start_download({0x2000, 0}, std::vector<std::uint8_t>(70), at_ms(0), SdoTransfer::Block);
  EXPECT_EQ(drain(master, at_ms(0)).size(), 1u);
  master.on_frame(from_bus(make_frame(0x583, {0xA0, 0x00, 0x20, 0, 127, 0, 0, 0}), at_ms(1)));
  EXPECT_EQ(drain(master, at_ms(1), 3).size(), 3u);
  node.send_rpdo(2, kData, 1);
  const Texts sent = drain(master, at_ms(1));
  EXPECT_EQ(sent[1], "303#01");
  EXPECT_EQ(sent.size(), 8u);
}

TEST(MasterTiming, SyncAndHeartbeatAreSentPeriodically) {
  MasterParameters parameters;
  parameters.sync_period = milliseconds(10);
  parameters.heartbeat_period = milliseconds(25);
  parameters.own_node_id = 100;
  Master master("can0", parameters);
  std::vector<std::pair<std::int64_t, std::string>> sent;
  HostTime now = at_ms(0);
  while (now <= at_ms(60)) {
    master.poll(now);
    for (const auto& text : drain(master, now))
      sent.emplace_back(now.time_since_epoch() / milliseconds(1), text);
    now = master.next_deadline();
  }
  const std::vector<std::pair<std::int64_t, std::string>> expected{
      {0, "764#05"}, {10, "080#"}, {20, "080#"},   {25, "764#05"}, {30, "080#"},
      {40, "080#"},  {50, "080#"}, {50, "764#05"}, {60, "080#"}};
  EXPECT_EQ(sent, expected);
}

// After a stall of the host there is much to send, and the drives have waited for its heartbeat.
TEST(MasterTiming, TheHeartbeatWaitsForNothingThatWasMadeBefore) {
  MasterParameters parameters;
  parameters.heartbeat_period = milliseconds(25);
  Master master("can0", parameters);
  NodeLink& node = master.add_node(3);
  master.poll(at_ms(0));
  ASSERT_EQ(drain(master, at_ms(0)), Texts{"77F#05"});
  const std::uint8_t halt[] = {0x0F, 0x01};
  ASSERT_TRUE(node.send_rpdo(2, halt, 2));
  ASSERT_TRUE(node.sdo().start_upload({0x6041, 0}, at_ms(1)));
  ASSERT_TRUE(master.request_sync(at_ms(1)));
  ASSERT_TRUE(node.send_record(1, kData, 8));
  master.poll(at_ms(100));
  EXPECT_EQ(drain(master, at_ms(100)),
            (Texts{"77F#05", "303#0F01", "603#4041600000000000", "080#", "203#0102030405060708"}));
}

TEST(MasterTiming, PeriodicFramesDoNotPileUpWhileTheBusIsDown) {
  MasterParameters parameters;
  parameters.sync_period = milliseconds(1);
  parameters.heartbeat_period = milliseconds(1);
  Master master("can0", parameters);
  for (int ms = 0; ms < 1000; ++ms) master.poll(at_ms(ms));
  EXPECT_EQ(master.pending_control(), 2u);
  EXPECT_EQ(master.control_overflows(), 0u);
}

TEST(MasterTiming, SdoTimesOutAndFreesTheClient) {
  Master master("can0");
  NodeLink& node = master.add_node(3);
  node.sdo().start_upload({0x6041, 0}, at_ms(0));
  drain(master, at_ms(10));
  EXPECT_EQ(master.next_deadline(), at_ms(260));
  master.poll(at_ms(260));
  EXPECT_EQ(drain(master, at_ms(260)), (Texts{"603#8041600000000405"}));
  EXPECT_EQ(
      node.sdo().take_result()->text(),
      "node 3: read of 0x6041:00 failed: abort 0x05040000 SDO protocol timed out (sent by this host; last "
      "sent to the drive: 603#4041600000000000); no answer came within 0.25 s: check the drive's power, "
      "node id and bit rate; where it answers later than that, raise sdo_timeout of the bus");
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
