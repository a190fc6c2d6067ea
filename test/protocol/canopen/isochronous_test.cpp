#include <gtest/gtest.h>

#include <stdexcept>

#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/protocol/canopen/sync_timing.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/drain.h"

// SYNC as the time base of drives, and how it is measured.
namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

class IsochronousMaster : public testing::Test {
 protected:
  static MasterParameters parameters() {
    MasterParameters p;
    p.sync_period = milliseconds(10);
    p.isochronous = true;
    return p;
  }

  /// SYNC is due at 10, 20, ... ms from here on.
  void SetUp() override { master.poll(at_ms(0)); }

  Texts sent_at(HostTime now) {
    master.poll(now);
    return drain(master, now);
  }

  /// The last SYNC was on the bus at `time`.
  void confirm(HostTime time) { master.on_frame({sync_frame(), time, true}); }

  Master master{"can0", parameters()};
};

TEST_F(IsochronousMaster, TellsWhenTheNextSyncIsDue) {
  EXPECT_EQ(master.next_sync_due(), at_ms(10));
  EXPECT_EQ(sent_at(at_ms(10)), Texts{"080#"});
  EXPECT_EQ(master.next_sync_due(), at_ms(20));
  EXPECT_EQ(Master("can1").next_sync_due(), kNever);
}

TEST_F(IsochronousMaster, ThereIsNoSyncOnRequest) {
  EXPECT_TRUE(master.request_sync(at_ms(3)));
  EXPECT_EQ(sent_at(at_ms(3)), Texts{});
  EXPECT_EQ(sent_at(at_ms(10)), Texts{"080#"});
}

TEST_F(IsochronousMaster, SyncUpToHalfAPeriodLateIsSent) {
  EXPECT_EQ(sent_at(at_ms(15)), Texts{"080#"});
  EXPECT_EQ(master.sync_timing().skipped(), 0u);
  EXPECT_EQ(master.next_sync_due(), at_ms(20));
}

TEST_F(IsochronousMaster, SyncThatIsLaterIsLeftOut) {
  EXPECT_EQ(sent_at(at_ms(15) + microseconds(1)), Texts{});
  EXPECT_EQ(master.sync_timing().skipped(), 1u);
  EXPECT_EQ(sent_at(at_ms(20)), Texts{"080#"});
}

// What waits in the drives for SYNC is of the time before the stall.
TEST_F(IsochronousMaster, AfterAStallTheNextSyncOnTheGridIsTheFirst) {
  EXPECT_EQ(sent_at(at_ms(31)), Texts{});
  EXPECT_EQ(master.sync_timing().skipped(), 3u);
  EXPECT_EQ(master.next_sync_due(), at_ms(40));
  EXPECT_EQ(sent_at(at_ms(40)), Texts{"080#"});
}

TEST_F(IsochronousMaster, SyncThatTheBusDidNotTakeInTimeIsDroppedAndOthersGoOn) {
  NodeLink& node = master.add_node(3);
  master.poll(at_ms(10));
  node.send_rpdo(1, kData, 2);
  EXPECT_EQ(drain(master, at_ms(16)), Texts{"203#0102"});
  EXPECT_EQ(master.sync_timing().skipped(), 1u);
  EXPECT_EQ(sent_at(at_ms(20)), Texts{"080#"});
}

TEST_F(IsochronousMaster, OnOtherBusesALateSyncIsSent) {
  MasterParameters p = parameters();
  p.isochronous = false;
  Master other("can1", p);
  other.poll(at_ms(0));
  other.poll(at_ms(38));
  EXPECT_EQ(drain(other, at_ms(38)), Texts{"080#"});
  EXPECT_EQ(other.sync_timing().skipped(), 0u);
}

TEST_F(IsochronousMaster, NeedsAPeriod) {
  MasterParameters p;
  p.isochronous = true;
  try {
    Master other("can1", p);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("sync_period"), std::string::npos) << error.what();
  }
}

TEST_F(IsochronousMaster, DelayIsMeasuredFromTheGridToTheEndOnTheBus) {
  for (std::int64_t i = 1; i <= 200; ++i) {
    sent_at(at_ms(10 * i));
    confirm(at_ms(10 * i) + microseconds(i % 2 == 0 ? 40 : 60));
  }
  EXPECT_NEAR(master.sync_timing().delay(), 50e-6, 2e-6);
  EXPECT_NEAR(master.sync_timing().jitter(), 10e-6, 2e-6);
}

TEST(SyncTimingOf, NothingIsZero) {
  const SyncTiming timing;
  EXPECT_EQ(timing.delay(), 0.0);
  EXPECT_EQ(timing.jitter(), 0.0);
}

TEST(SyncTimingOf, OneLateSyncIsForgottenAfterTwoSeconds) {
  SyncTiming timing;
  for (std::int64_t i = 1; i <= 500; ++i) {
    const HostTime due = at_ms(10 * i);
    timing.confirm(due, due + (i == 150 ? microseconds(3050) : microseconds(50)));
    if (i == 200) {
      EXPECT_NEAR(timing.jitter(), 3e-3, 1e-5);
    }
  }
  EXPECT_LE(timing.jitter(), 1e-6);
  EXPECT_NEAR(timing.delay(), 50e-6, 1e-6);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
