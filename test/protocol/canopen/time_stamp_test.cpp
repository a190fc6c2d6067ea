#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/canopen/sync.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"

// The master tells the drives when SYNC was on the bus: CiA 301, object 1013h.
namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::milliseconds;

MasterParameters with_time_stamps(int period = 1) {
  MasterParameters parameters;
  parameters.time_stamp_period = period;
  return parameters;
}

/// A SYNC given to the bus at `sent` that ends on it at `end`.
Texts sync(Master& master, HostTime sent, HostTime end) {
  master.request_sync(sent);
  Texts frames = drain(master, sent);
  master.on_frame(from_bus(sync_frame(), end, true));
  for (const auto& text : drain(master, end)) frames.push_back(text);
  return frames;
}

TEST(TimeStamp, CountsMicrosecondsModulo32Bits) {
  EXPECT_EQ(time_stamp_of(HostTime{}), 0u);
  EXPECT_EQ(time_stamp_of(HostTime(std::chrono::nanoseconds(1'999))), 1u);
  EXPECT_EQ(time_stamp_of(at_us(4'294'967'295)), 0xFFFFFFFFu);
  EXPECT_EQ(time_stamp_of(at_us(4'294'967'296)), 0u);
  EXPECT_EQ(time_stamp_of(at_us(4'294'967'296 * 3 + 5)), 5u);
  EXPECT_EQ(time_stamp_frame(127, at_us(0x12345678)), make_frame(0x47F, {0x78, 0x56, 0x34, 0x12}));
}

TEST(TimeStamp, HasAnIdentifierOfItsOwn) {
  for (unsigned host = 1; host <= 127; ++host) {
    const std::uint32_t id = cob_id::time_stamp(static_cast<std::uint8_t>(host));
    EXPECT_EQ(id, 0x400u + host);
    // A drive has another node id, so the identifier is none of its services.
    EXPECT_EQ(classify(id).node, host);
    EXPECT_EQ(classify(id).service, Service::Rpdo);
  }
}

TEST(TimeStamp, FollowsItsSyncWithTheTimeAtWhichThatWasOnTheBus) {
  Master master("can0", with_time_stamps());
  EXPECT_EQ(sync(master, at_us(1'000'000), at_us(1'000'051)), (Texts{"080#", "47F#73420F00"}));
  EXPECT_EQ(sync(master, at_us(1'010'000), at_us(1'010'300)), (Texts{"080#", "47F#7C6A0F00"}));
  EXPECT_EQ(master.time_stamps_sent(), 2u);
}

TEST(TimeStamp, IsOffUnlessAskedForAndComesWithEveryNthSync) {
  Master none("can0");
  EXPECT_EQ(sync(none, at_us(10), at_us(60)), (Texts{"080#"}));
  Master third("can0", with_time_stamps(3));
  int stamps = 0;
  for (std::int64_t i = 1; i <= 9; ++i) {
    const auto frames = sync(third, at_ms(10 * i), at_us(10'000 * i + 50));
    EXPECT_EQ(frames.size(), i % 3 == 0 ? 2u : 1u) << i;
    stamps += static_cast<int>(frames.size()) - 1;
  }
  EXPECT_EQ(stamps, 3);
}

TEST(TimeStamp, ComesWithPeriodicSyncsToo) {
  MasterParameters parameters = with_time_stamps();
  parameters.sync_period = milliseconds(10);
  Master master("can0", parameters);
  master.poll(at_ms(0));
  master.poll(at_ms(10));
  EXPECT_EQ(drain(master, at_ms(10)), (Texts{"080#"}));
  master.on_frame(from_bus(sync_frame(), at_us(10'051), true));
  EXPECT_EQ(drain(master, at_us(10'051)), (Texts{"47F#43270000"}));
}

// A drive takes a time stamp for that of the SYNC it saw last.
TEST(TimeStamp, GoesBeforeEverythingThatWaitsSoBeforeTheNextSync) {
  Master master("can0", with_time_stamps());
  NodeLink& node = master.add_node(3);
  master.request_sync(at_us(0));
  ASSERT_EQ(drain(master, at_us(0)).size(), 1u);
  node.send_nmt(NmtCommand::Start);
  node.send_record(1, kData, 8);
  master.request_sync(at_us(20));
  master.on_frame(from_bus(sync_frame(), at_us(48), true));
  EXPECT_EQ(drain(master, at_us(48)), (Texts{"47F#30000000", "000#0103", "080#", "203#0102030405060708"}));
}

TEST(TimeStamp, IsLeftOutWhenTheNextSyncIsUnderWay) {
  Master master("can0", with_time_stamps());
  master.request_sync(at_us(0));
  master.request_sync(at_us(0));
  EXPECT_EQ(drain(master, at_us(0)), (Texts{"080#", "080#"}));
  master.on_frame(from_bus(sync_frame(), at_us(48), true));
  EXPECT_EQ(drain(master, at_us(48)), Texts{});
  master.on_frame(from_bus(sync_frame(), at_us(99), true));
  EXPECT_EQ(drain(master, at_us(99)), Texts{});
  EXPECT_EQ(sync(master, at_ms(10), at_us(10'048)).size(), 2u) << "and goes on with the next";
}

TEST(TimeStamp, ASyncWhoseConfirmationIsLostCostsOneTimeStamp) {
  Master master("can0", with_time_stamps());
  master.request_sync(at_ms(0));
  EXPECT_EQ(drain(master, at_ms(0)).size(), 1u);
  EXPECT_EQ(sync(master, at_ms(10), at_us(10'048)).size(), 1u);
  EXPECT_EQ(sync(master, at_ms(20), at_us(20'048)).size(), 2u);
}

TEST(TimeStamp, OneThatCouldNotBeSentIsDroppedWithTheRest) {
  Master master("can0", with_time_stamps());
  master.request_sync(at_us(0));
  ASSERT_EQ(drain(master, at_us(0)), Texts{"080#"});
  master.on_frame(from_bus(sync_frame(), at_us(48), true));
  ASSERT_EQ(to_string(*master.peek_outgoing(at_us(50))), "47F#30000000");
  master.clear_outgoing();
  EXPECT_EQ(master.peek_outgoing(at_us(60)), nullptr);
  EXPECT_EQ(master.time_stamps_sent(), 0u);
  EXPECT_EQ(sync(master, at_us(100), at_us(160)), (Texts{"080#", "47F#A0000000"}));
}

TEST(TimeStamp, AnothersSyncHasNone) {
  Master master("can0", with_time_stamps());
  master.on_frame(from_bus(sync_frame(), at_us(48)));
  EXPECT_EQ(drain(master, at_us(48)), Texts{});
}

TEST(TimeStamp, PeriodIsChecked) {
  for (const int period : {-1, 1001}) {
    EXPECT_THROW(Master("can0", with_time_stamps(period)), std::invalid_argument) << period;
  }
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
