#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/canopen/bus_load.h"
#include "interpolated_motion_driver/protocol/canopen/heartbeat.h"
#include "interpolated_motion_driver/protocol/canopen/pacer.h"
#include "interpolated_motion_driver/protocol/canopen/sync.h"
#include "protocol/canopen/bytes.h"

namespace interpolated_motion::canopen::test {
namespace {

using std::chrono::milliseconds;

TEST(HeartbeatConsumer, NothingIsMonitoredBeforeTheFirstHeartbeat) {
  HeartbeatConsumer consumer(milliseconds(150));
  EXPECT_EQ(consumer.next_deadline(), kNever);
  consumer.poll(at_ms(100000));
  EXPECT_FALSE(consumer.take_event());
  EXPECT_EQ(consumer.state(), NodeState::Unknown);
}

TEST(HeartbeatConsumer, LossIsReportedOnceAndRecoveryAfterIt) {
  HeartbeatConsumer consumer(milliseconds(150));
  consumer.on_heartbeat(NodeState::PreOperational, at_ms(1000));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Started);
  EXPECT_EQ(consumer.next_deadline(), at_ms(1150));
  consumer.on_heartbeat(NodeState::Operational, at_ms(1100));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::StateChanged);
  consumer.on_heartbeat(NodeState::Operational, at_ms(1200));
  EXPECT_FALSE(consumer.take_event());
  consumer.poll(at_ms(1349));
  EXPECT_FALSE(consumer.lost());
  consumer.poll(at_ms(1350));
  EXPECT_TRUE(consumer.lost());
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Lost);
  EXPECT_EQ(consumer.next_deadline(), kNever);
  consumer.poll(at_ms(2000));
  EXPECT_FALSE(consumer.take_event());
  consumer.on_heartbeat(NodeState::Operational, at_ms(2100));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Started);
  EXPECT_FALSE(consumer.lost());
}

TEST(HeartbeatConsumer, BootUpStopsMonitoringUntilTheNextHeartbeat) {
  HeartbeatConsumer consumer(milliseconds(150));
  consumer.on_heartbeat(NodeState::Operational, at_ms(0));
  consumer.on_heartbeat(NodeState::BootUp, at_ms(100));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Started);
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::BootUp);
  EXPECT_EQ(consumer.next_deadline(), kNever);
  consumer.poll(at_ms(1000));
  EXPECT_FALSE(consumer.take_event());
  EXPECT_EQ(consumer.state(), NodeState::BootUp);
  consumer.on_heartbeat(NodeState::PreOperational, at_ms(1100));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Started);
}

TEST(HeartbeatConsumer, WithoutTimeoutStatesAreStillReported) {
  HeartbeatConsumer consumer;
  consumer.on_heartbeat(NodeState::PreOperational, at_ms(0));
  EXPECT_EQ(consumer.next_deadline(), kNever);
  consumer.on_heartbeat(NodeState::BootUp, at_ms(5));
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::Started);
  EXPECT_EQ(consumer.take_event(), HeartbeatEvent::BootUp);
  consumer.on_heartbeat(NodeState::PreOperational, at_ms(10));
  consumer.set_timeout(milliseconds(20));
  EXPECT_EQ(consumer.next_deadline(), at_ms(30));
}

TEST(HeartbeatProducer, PeriodWithoutBursts) {
  HeartbeatProducer producer(127, milliseconds(100));
  EXPECT_EQ(producer.next_deadline(), kNever);
  EXPECT_EQ(producer.poll(at_ms(5)), make_frame(0x77F, {0x05}));
  EXPECT_EQ(producer.next_deadline(), at_ms(105));
  EXPECT_FALSE(producer.poll(at_ms(104)));
  EXPECT_TRUE(producer.poll(at_ms(105)));
  EXPECT_TRUE(producer.poll(at_ms(900)));
  EXPECT_FALSE(producer.poll(at_ms(901)));
  HeartbeatProducer off(127, HostDuration::zero());
  EXPECT_FALSE(off.poll(at_ms(0)));
}

TEST(SyncProducer, KeepsItsGridAndSkipsWhatWasMissed) {
  SyncProducer producer(milliseconds(10));
  EXPECT_FALSE(producer.poll(at_ms(0)));
  EXPECT_EQ(producer.next_deadline(), at_ms(10));
  EXPECT_FALSE(producer.poll(at_ms(9)));
  EXPECT_TRUE(producer.poll(at_ms(12)));
  EXPECT_EQ(producer.next_deadline(), at_ms(20));
  EXPECT_TRUE(producer.poll(at_ms(57)));
  EXPECT_FALSE(producer.poll(at_ms(59)));
  EXPECT_EQ(producer.next_deadline(), at_ms(60));
  EXPECT_EQ(sync_frame(), make_frame(0x080, {}));
}

TEST(Pacer, BurstThenInterval) {
  Pacer pacer(std::chrono::microseconds(225), 4);
  const HostTime t0 = at_ms(1000);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(pacer.ready(t0)) << i;
    pacer.consume(t0);
  }
  EXPECT_FALSE(pacer.ready(t0));
  EXPECT_EQ(pacer.ready_time(), t0 + std::chrono::microseconds(225));
  pacer.consume(t0 + std::chrono::microseconds(225));
  EXPECT_EQ(pacer.ready_time(), t0 + std::chrono::microseconds(450));
  // After a pause the burst is there again, but not more than it.
  const HostTime t1 = at_ms(2000);
  for (int i = 0; i < 4; ++i) pacer.consume(t1);
  EXPECT_FALSE(pacer.ready(t1));
}

Frame with_length(int n) {
  Frame frame = make_frame(0x203, {});
  frame.length = static_cast<std::uint8_t>(n);
  return frame;
}

TEST(FrameBits, WorstCaseOfTheScheduleAnalysis) {
  // Davis, Burns, Bril, Lukkien: (55 + 10 s) bits for 11-bit identifiers, (80 + 10 s) for 29-bit ones.
  for (int n = 0; n <= 8; ++n) {
    EXPECT_EQ(worst_case_bits(with_length(n)), static_cast<unsigned>(55 + 10 * n));
    Frame extended = with_length(n);
    extended.extended = true;
    EXPECT_EQ(worst_case_bits(extended), static_cast<unsigned>(80 + 10 * n));
  }
  Frame remote = with_length(8);
  remote.remote = true;
  EXPECT_EQ(worst_case_bits(remote), 55u);
}

TEST(FrameBits, AverageOfPvtFrames) {
  EXPECT_NEAR(average_bits(with_length(8)), 118.3, 0.5);  // mean of 118.3 bits over a sine of records
}

TEST(BusLoad, ShareOfTheLastSecond) {
  BusLoad load(1'000'000);
  EXPECT_EQ(load.load(at_ms(5000)), 0.0);
  // 1000 frames of 8 bytes per second, for 3 s: 1000 x 118.5 bits in 1 Mbit.
  for (int ms = 0; ms < 3000; ++ms) load.add(with_length(8), at_ms(5000 + ms));
  EXPECT_NEAR(load.load(at_ms(7999)), 0.1185, 0.001);
  EXPECT_NEAR(load.load(at_us(7'999'999)), 0.1185, 0.001);
  // Half a second later half of it is left, a second later nothing.
  EXPECT_NEAR(load.load(at_us(8'499'999)), 0.059, 0.001);
  EXPECT_EQ(load.load(at_ms(9000)), 0.0);
}

TEST(BusLoad, FramesHandedOverTooLateDoNotDisturb) {
  BusLoad load(1'000'000);
  for (int i = 0; i < 100; ++i) load.add(with_length(8), at_ms(10'050));
  const double before = load.load(at_ms(10'099));
  load.add(with_length(8), at_ms(9'050));
  EXPECT_EQ(load.load(at_ms(10'099)), before);
  EXPECT_GT(before, 0.0);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
