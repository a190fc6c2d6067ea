#include "interpolated_motion_driver/axis/stage_time.h"

#include <gtest/gtest.h>

namespace interpolated_motion::axis {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kStart{1000s};

/// Polled each 10 ms for `duration`, from `from` on.
HostTime poll_through(StageTime& time, HostTime from, HostDuration duration) {
  for (HostTime now = from; now <= from + duration; now += 10ms) EXPECT_EQ(time.poll(now), 0ns);
  return from + duration;
}

TEST(StageTime, LimitRunsWhileTheHostIsThere) {
  StageTime time;
  time.begin(kStart);
  const HostTime now = poll_through(time, kStart, 1s);
  EXPECT_FALSE(time.expired(now, 1s));
  EXPECT_TRUE(time.expired(now, 990ms));
}

TEST(StageTime, WhatTheHostIsAwayForDoesNotCount) {
  StageTime time;
  time.begin(kStart);
  HostTime now = poll_through(time, kStart, 1s);
  EXPECT_EQ(time.poll(now + 5s), 5s);
  now = poll_through(time, now + 5s, 500ms);
  EXPECT_FALSE(time.expired(now, 1500ms));
  EXPECT_TRUE(time.expired(now, 1490ms));
}

TEST(StageTime, AnAbsenceBeforeTheStageIsNoneWithinIt) {
  StageTime time;
  time.begin(kStart);
  poll_through(time, kStart, 100ms);
  time.begin(kStart + 3s);
  EXPECT_EQ(time.poll(kStart + 3s), 0ns);
  EXPECT_TRUE(time.expired(kStart + 4s, 990ms));
}

// A report that came while the host was away is taken before the absence is noted.
TEST(StageTime, SilenceIsWhatTheHostWasThereToHear) {
  StageTime time;
  time.begin(kStart);
  HostTime now = poll_through(time, kStart, 100ms);
  const HostTime last = now;
  time.note_report();
  now += 2s;
  time.poll(now);
  EXPECT_EQ(time.silence(now, last), 0ns);
  now = poll_through(time, now, 300ms);
  EXPECT_EQ(time.silence(now, last), 300ms);
  time.note_report();
  EXPECT_EQ(time.silence(now, now), 0ns);
  EXPECT_EQ(time.silence(now + 50ms, now), 50ms);
}

}  // namespace
}  // namespace interpolated_motion::axis
