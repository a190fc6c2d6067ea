#include "interpolated_motion_driver/axis/epos/record_feed.h"

#include <gtest/gtest.h>

namespace interpolated_motion::axis {
namespace {

/// `count` records of `time` ms each.
encoding::PvtStream stream(int count, std::uint8_t time) {
  encoding::PvtStream stream;
  for (int i = 1; i <= count; ++i) stream.records.push_back({100 * i, 0, time});
  stream.duration = DriveMilliseconds(count * time);
  return stream;
}

int send_all_due(RecordFeed& feed, double least_played, double played) {
  int sent = 0;
  for (; feed.next(least_played, played); ++sent) feed.mark_sent();
  return sent;
}

TEST(RecordFeed, EndsWithARecordOfTimeZeroAtTheLastPosition) {
  RecordFeed feed;
  feed.load(stream(3, 100), {64, 10.0});
  EXPECT_EQ(feed.size(), 4u);
  for (int i = 0; i < 3; ++i) feed.mark_sent();
  EXPECT_EQ(feed.next(0.0, 0.0), (PvtRecord{300, 0, 0}));
  feed.mark_sent();
  EXPECT_TRUE(feed.all_sent());
  EXPECT_FALSE(feed.next(0.0, 0.0));
}

TEST(RecordFeed, NeverFillsTheFifoToTheBrim) {
  RecordFeed feed;
  feed.load(stream(200, 10), {64, 100.0});
  EXPECT_EQ(send_all_due(feed, 0.0, 0.0), 62);
  EXPECT_EQ(send_all_due(feed, 0.0099, 0.0101), 0) << "the drive may not have reached the first record yet";
  EXPECT_EQ(send_all_due(feed, 0.0101, 0.0110), 1);
}

TEST(RecordFeed, CountsWhatHasBeenPlayedInWhateverOrderItIsAsked) {
  RecordFeed feed;
  feed.load(stream(100, 10), {64, 10.0});
  for (int i = 0; i < 1000; ++i) {
    const int ms = i * 7919 % 1013;
    EXPECT_EQ(feed.played(1e-3 * ms + 5e-4), static_cast<std::size_t>(ms < 1000 ? ms / 10 : 101)) << ms;
  }
}

// From rest to rest over 100 counts in 100 ms a cubic is 1.5 times as fast half-way as in the mean.
TEST(RecordFeed, VelocityAheadIsThatOfTheRecordsSent) {
  RecordFeed feed;
  feed.load(stream(3, 100), {64, 10.0});
  EXPECT_EQ(feed.fastest_ahead(0.0, 1.0), 0.0);
  feed.mark_sent();
  EXPECT_GE(feed.fastest_ahead(0.0, 1.0), 1500.0);
  EXPECT_LE(feed.fastest_ahead(0.0, 1.0), 3000.0);
  EXPECT_EQ(feed.fastest_ahead(0.101, 1.0), 0.0) << "the second record has not been sent";
  while (!feed.all_sent()) feed.mark_sent();
  EXPECT_GE(feed.fastest_ahead(0.25, 1.0), 1500.0);
  EXPECT_EQ(feed.fastest_ahead(0.301, 1.0), 0.0);
}

TEST(RecordFeed, VelocityAheadIsInTheUnitOfTheDrive) {
  encoding::PvtStream straight;
  straight.records = {{100, 500, 200}, {200, 500, 100}, {250, 0, 200}};
  straight.duration = DriveMilliseconds(500);
  RecordFeed feed;
  feed.load(straight, {64, 10.0});
  while (!feed.all_sent()) feed.mark_sent();
  EXPECT_NEAR(feed.fastest_ahead(0.0, 2.0), 1000.0, 1e-9);
  EXPECT_NEAR(feed.fastest_ahead(0.25, 2.0), 1000.0, 1e-9);
}

// The last record in the drive is not counted: as the drive begins it, it needs the knot behind it.
TEST(RecordFeed, KeepsTheHorizonAhead) {
  RecordFeed feed;
  feed.load(stream(200, 100), {64, 2.0});
  EXPECT_EQ(send_all_due(feed, 0.0, 0.0), 21);
  EXPECT_NEAR(feed.time_ahead(0.05), 2.05, 1e-12);
  EXPECT_EQ(send_all_due(feed, 1.0, 1.0), 10);
}

TEST(RecordFeed, HoldsAtLeastFourRecordsHoweverShortTheHorizon) {
  RecordFeed feed;
  feed.load(stream(50, 250), {64, 0.1});
  EXPECT_EQ(send_all_due(feed, 0.0, 0.0), 4);
  EXPECT_EQ(send_all_due(feed, 0.24, 0.26), 1);
}

TEST(RecordFeed, CountsWhatHasBeenPlayed) {
  RecordFeed feed;
  feed.load(stream(3, 100), {64, 10.0});
  EXPECT_EQ(feed.played(0.099), 0u);
  EXPECT_EQ(feed.played(0.101), 1u);
  EXPECT_EQ(feed.played(0.301), 4u) << "the record that ends the mode takes no time";
}

// The drive must find two records whenever it reaches one, and has 62 places to use.
TEST(RecordFeed, SlotsTellWhenEachRecordMayAndMustComeOverTheBus) {
  RecordFeed feed;
  feed.load(stream(100, 10), {64, 100.0});
  const auto slots = feed.slots(GoalTime{-0.5});
  ASSERT_EQ(slots.size(), 101u);
  EXPECT_DOUBLE_EQ(slots[0].deadline.count(), -0.5);
  EXPECT_DOUBLE_EQ(slots[1].deadline.count(), -0.5);
  EXPECT_NEAR(slots[2].deadline.count(), -0.5 + 0.010, 1e-12);
  EXPECT_NEAR(slots[61].release.count(), -0.5, 1e-12);
  EXPECT_NEAR(slots[62].release.count(), -0.5 + 0.010, 1e-12);
}

TEST(RecordFeed, WhatHasNotBeenSentCanBeReplaced) {
  RecordFeed feed;
  feed.load(stream(10, 20), {64, 0.08});
  EXPECT_EQ(send_all_due(feed, 0.0, 0.0), 5);
  EXPECT_EQ(feed.committed_knot().sample, 100);
  EXPECT_EQ(feed.committed_knot().position, 500);
  encoding::PvtStream other;
  other.records = {{700, 3, 30}, {800, 0, 40}};
  feed.replace_uncommitted(other, {64, 0.1});
  EXPECT_EQ(feed.size(), 8u);
  EXPECT_EQ(feed.sent(), 5u);
  EXPECT_NEAR(feed.duration(), 0.170, 1e-12);
  EXPECT_EQ(feed.next(0.05, 0.05), (PvtRecord{700, 3, 30}));
  feed.mark_sent();
  feed.mark_sent();
  EXPECT_EQ(feed.next(0.16, 0.16), (PvtRecord{800, 0, 0})) << "the record that ends the mode";
  EXPECT_EQ(feed.final_position(), 800);
}

TEST(RecordFeed, CountsOnWhenOldRecordsAreForgotten) {
  RecordFeed feed;
  feed.load(stream(10, 20), {64, 0.1});
  double elapsed = 0.0;
  for (std::size_t i = 0; i < 5000; ++i) {
    feed.replace_uncommitted(stream(10, 20), {64, 0.1});
    while (feed.next(elapsed, elapsed)) feed.mark_sent();
    ASSERT_FALSE(feed.all_sent());
    ASSERT_EQ(feed.played(elapsed + 0.01), i);
    ASSERT_NEAR(feed.end(feed.sent() - 1), 0.02 * static_cast<double>(feed.sent()), 1e-6);
    elapsed += 0.02;
  }
}

}  // namespace
}  // namespace interpolated_motion::axis
