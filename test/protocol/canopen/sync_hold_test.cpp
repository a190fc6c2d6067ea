#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/canopen/sync_answers.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"

// One SYNC after the other: the next waits until the last has been on the bus and has been answered.
namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::milliseconds;

MasterParameters parameters() {
  MasterParameters p;
  p.sync_period = milliseconds(10);
  p.heartbeat_timeout = milliseconds(
      400);  // so a SYNC waits for the last one by 100 ms at most, for its answers by three periods
  return p;
}

class SyncHold : public testing::Test {
 protected:
  void SetUp() override {
    node.set_sync_answer(2);
    master.poll(at_ms(0));
  }

  /// Whether the periodic SYNC that is due at `ms` is sent.
  bool sent_at(std::int64_t ms) {
    master.poll(at_ms(ms));
    return drain(master, at_ms(ms)) == Texts{"080#"};
  }

  void confirm(std::int64_t ms) { master.on_frame(from_bus(sync_frame(), at_ms(ms), true)); }
  void answer(std::int64_t ms) { master.on_frame(from_bus(make_frame(0x283, {1, 2}), at_ms(ms))); }

  Master master{"can0", parameters()};
  NodeLink& node = master.add_node(3);
};

TEST_F(SyncHold, OneThatIsNotOnTheBusYetHoldsTheNextBack) {
  EXPECT_TRUE(sent_at(10));
  for (std::int64_t ms = 20; ms <= 100; ms += 10) EXPECT_FALSE(sent_at(ms)) << ms;
  confirm(104);
  EXPECT_TRUE(sent_at(110)) << "one, not all those that were due";
  EXPECT_EQ(master.syncs_confirmed(), 1u);
}

TEST_F(SyncHold, OneWhoseConfirmationIsLostIsNotWaitedForLong) {
  EXPECT_TRUE(sent_at(10));
  EXPECT_FALSE(sent_at(100));
  EXPECT_TRUE(sent_at(110));
}

TEST_F(SyncHold, OneThatWasDroppedWithTheRestIsNotWaitedFor) {
  EXPECT_TRUE(sent_at(10));
  master.clear_outgoing();
  EXPECT_TRUE(sent_at(20));
}

TEST_F(SyncHold, ANodeThatHasNotAnsweredYetIsNotWaitedFor) {
  for (std::int64_t ms = 10; ms <= 50; ms += 10) {
    EXPECT_TRUE(sent_at(ms)) << ms;
    confirm(ms);
  }
}

TEST_F(SyncHold, AMissingAnswerHoldsTheNextBackUntilItComes) {
  EXPECT_TRUE(sent_at(10));
  confirm(10);
  answer(11);
  EXPECT_TRUE(sent_at(20));
  confirm(20);
  EXPECT_FALSE(sent_at(30));
  EXPECT_FALSE(sent_at(40));
  answer(45);
  EXPECT_TRUE(sent_at(50));
}

TEST_F(SyncHold, EachSyncIsToBeAnswered) {
  EXPECT_TRUE(sent_at(10));
  confirm(10);
  answer(11);
  master.request_sync(at_ms(12));
  EXPECT_EQ(drain(master, at_ms(12)), Texts{"080#"});
  confirm(12);
  EXPECT_FALSE(sent_at(20));
  answer(21);
  EXPECT_TRUE(sent_at(30));
  master.request_sync(at_ms(31));
  EXPECT_EQ(drain(master, at_ms(31)), Texts{"080#"});
  confirm(31);
  confirm(31);
  answer(32);
  EXPECT_FALSE(sent_at(40));
  answer(41);
  EXPECT_TRUE(sent_at(50));
}

TEST_F(SyncHold, AnotherPdoIsNoAnswer) {
  EXPECT_TRUE(sent_at(10));
  confirm(10);
  answer(11);
  EXPECT_TRUE(sent_at(20));
  confirm(20);
  master.on_frame(from_bus(make_frame(0x183, {1, 2}), at_ms(21)));
  EXPECT_FALSE(sent_at(30));
}

TEST_F(SyncHold, ANodeThatFallsSilentIsWaitedForOnce) {
  EXPECT_TRUE(sent_at(10));
  confirm(10);
  answer(11);
  EXPECT_TRUE(sent_at(20));
  confirm(20);
  EXPECT_FALSE(sent_at(40));
  EXPECT_TRUE(sent_at(50));
  confirm(50);
  EXPECT_TRUE(sent_at(60));
  confirm(60);
  answer(61);
  EXPECT_TRUE(sent_at(70));
  confirm(70);
  EXPECT_FALSE(sent_at(80)) << "it answers again, so it is waited for again";
}

TEST(SyncHoldIsochronous, NoSyncWaitsForAnother) {
  MasterParameters p = parameters();
  p.isochronous = true;
  Master master("can0", p);
  master.add_node(3).set_sync_answer(2);
  master.poll(at_ms(0));
  const auto sent_at = [&master](std::int64_t ms) {
    master.poll(at_ms(ms));
    return drain(master, at_ms(ms)) == Texts{"080#"};
  };
  EXPECT_TRUE(sent_at(10));
  EXPECT_TRUE(sent_at(20)) << "though the last is not on the bus yet";
  master.on_frame(from_bus(sync_frame(), at_ms(21), true));
  master.on_frame(from_bus(make_frame(0x283, {1, 2}), at_ms(22)));
  EXPECT_TRUE(sent_at(30));
  master.on_frame(from_bus(sync_frame(), at_ms(30), true));
  EXPECT_TRUE(sent_at(40)) << "though the last is not answered yet";
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
