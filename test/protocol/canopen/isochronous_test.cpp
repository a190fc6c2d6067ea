#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

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

  /// The last row of SYNCs that `of` has left out: when the first and the last were due.
  static std::pair<HostTime, HostTime> left_out(const Master& of) {
    return {of.sync_timing().first_left_out(), of.sync_timing().last_left_out()};
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

// The queue of the bus is full for more than a period: neither the SYNC that waits nor the next one is sent.
TEST_F(IsochronousMaster, SyncBehindOneThatTheBusDidNotTakeIsLeftOutWithIt) {
  master.poll(at_ms(10));
  master.poll(at_ms(20));
  EXPECT_EQ(left_out(master), std::pair(at_ms(20), at_ms(20)));
  EXPECT_EQ(drain(master, at_ms(21)), Texts{});
  EXPECT_EQ(left_out(master), std::pair(at_ms(10), at_ms(20)));
  EXPECT_EQ(master.sync_timing().skipped(), 2u);
  EXPECT_EQ(sent_at(at_ms(30)), Texts{"080#"});
}

/// Tolerates 0.5 ms.
class StrictIsochronousMaster : public IsochronousMaster {
 protected:
  static MasterParameters strict() {
    MasterParameters p = parameters();
    p.sync_tolerance = microseconds(500);
    return p;
  }

  void SetUp() override { strict_.poll(at_ms(0)); }

  bool is_sent_at(HostTime now) {
    strict_.poll(now);
    return drain(strict_, now) == Texts{"080#"};
  }

  Master strict_{"can0", strict()};
};

TEST_F(StrictIsochronousMaster, SyncWithinTheToleranceIsSent) {
  EXPECT_TRUE(is_sent_at(at_ms(10) + microseconds(500)));
  EXPECT_EQ(strict_.sync_timing().skipped(), 0u);
}

TEST_F(StrictIsochronousMaster, LaterSyncIsLeftOutAndTheNextIsOnTheGrid) {
  EXPECT_FALSE(is_sent_at(at_ms(10) + microseconds(501)));
  EXPECT_EQ(strict_.sync_timing().skipped(), 1u);
  EXPECT_EQ(left_out(strict_), std::pair(at_ms(10), at_ms(10)));
  EXPECT_EQ(strict_.next_sync_due(), at_ms(20));
  EXPECT_TRUE(is_sent_at(at_ms(20)));
}

TEST_F(StrictIsochronousMaster, NotTwoInARow) {
  EXPECT_FALSE(is_sent_at(at_ms(12)));
  EXPECT_TRUE(is_sent_at(at_ms(22)));
  EXPECT_FALSE(is_sent_at(at_ms(32)));
  EXPECT_TRUE(is_sent_at(at_ms(45)));
  EXPECT_EQ(strict_.sync_timing().skipped(), 2u);
}

// A drive that hears every second SYNC only would never be led; a grid that is shifted a little does not
// matter as much.
TEST_F(StrictIsochronousMaster, NoneThatANodeNeeds) {
  strict_.add_node(3);
  NodeLink& node = strict_.add_node(4);
  node.set_needs_sync(true);
  EXPECT_TRUE(is_sent_at(at_ms(12)));
  EXPECT_TRUE(is_sent_at(at_ms(25)));
  EXPECT_FALSE(is_sent_at(at_ms(35) + microseconds(1))) << "of the past";
  node.set_needs_sync(false);
  EXPECT_TRUE(is_sent_at(at_ms(42)));
  EXPECT_FALSE(is_sent_at(at_ms(52)));
}

TEST_F(StrictIsochronousMaster, OneMoreThatIsLaterThanHalfAPeriodIsLeftOutAllTheSame) {
  EXPECT_FALSE(is_sent_at(at_ms(12)));
  EXPECT_FALSE(is_sent_at(at_ms(26)));
  EXPECT_EQ(strict_.sync_timing().skipped(), 2u);
  EXPECT_EQ(left_out(strict_), std::pair(at_ms(10), at_ms(20)));
  EXPECT_TRUE(is_sent_at(at_ms(31))) << "and time goes on from there";
}

TEST_F(StrictIsochronousMaster, AfterAStallOfPeriodsTheFirstSyncMayBeLate) {
  EXPECT_FALSE(is_sent_at(at_ms(31)));
  EXPECT_EQ(strict_.sync_timing().skipped(), 3u);
  EXPECT_EQ(left_out(strict_), std::pair(at_ms(10), at_ms(30)));
  EXPECT_TRUE(is_sent_at(at_ms(42)));
}

// A controlword that starts the drives waits in them for the next SYNC, whichever that is.
TEST_F(StrictIsochronousMaster, StartSignalComesWithTheSyncAfterTheOneLeftOut) {
  NodeLink& node = strict_.add_node(3);
  EXPECT_TRUE(node.send_rpdo(2, kData, 2));
  EXPECT_TRUE(strict_.request_sync(at_ms(9)));
  EXPECT_EQ(drain(strict_, at_ms(9)), Texts{"303#0102"});
  EXPECT_FALSE(is_sent_at(at_ms(13)));
  EXPECT_TRUE(is_sent_at(at_ms(20)));
}

TEST_F(StrictIsochronousMaster, RefusesAToleranceBeyondThePeriod) {
  MasterParameters p = strict();
  for (const HostDuration wrong : {HostDuration(milliseconds(11)), HostDuration(-1)}) {
    p.sync_tolerance = wrong;
    EXPECT_THROW(Master("can1", p), std::invalid_argument);
  }
}

TEST_F(IsochronousMaster, OnOtherBusesALateSyncIsSent) {
  MasterParameters p = parameters();
  p.isochronous = false;
  p.sync_tolerance = microseconds(500);
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
