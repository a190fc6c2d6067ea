#include "interpolated_motion_driver/node/periodic_calls.h"

#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

using std::chrono::milliseconds;

class PeriodicCallsTest : public ::testing::Test {
 protected:
  HostTime at(int ms) const { return origin_ + milliseconds(ms); }
  std::string polled_at(int ms) {
    called_.clear();
    calls_.poll(at(ms));
    return called_;
  }
  std::function<void()> calling(char name) {
    return [this, name] { called_ += name; };
  }

  const HostTime origin_{std::chrono::hours(3)};
  PeriodicCalls calls_{origin_};
  std::string called_;
};

TEST_F(PeriodicCallsTest, NothingIsDueWithoutCalls) {
  EXPECT_EQ(calls_.next_deadline(), kNever);
  EXPECT_EQ(polled_at(1000), "");
}

TEST_F(PeriodicCallsTest, EachIsCalledAtItsRateFromTheOriginOn) {
  calls_.add(50.0, calling('s'));
  calls_.add(20.0, calling('f'));
  std::string at_10_ms_steps;
  for (int ms = 0; ms <= 100; ms += 10) at_10_ms_steps += polled_at(ms) + ".";
  EXPECT_EQ(at_10_ms_steps, "..s..s.f.s..s..sf.");
}

TEST_F(PeriodicCallsTest, TheDeadlineIsTheEarliestCall) {
  calls_.add(10.0, calling('b'));
  calls_.add(50.0, calling('s'));
  EXPECT_EQ(calls_.next_deadline(), at(20));
  polled_at(20);
  EXPECT_EQ(calls_.next_deadline(), at(40));
}

TEST_F(PeriodicCallsTest, ALateCallKeepsItsPhase) {
  calls_.add(50.0, calling('s'));
  EXPECT_EQ(polled_at(27), "s");
  EXPECT_EQ(calls_.next_deadline(), at(40));
}

TEST_F(PeriodicCallsTest, MissedPeriodsAreLeftOut) {
  calls_.add(50.0, calling('s'));
  EXPECT_EQ(polled_at(207), "s");
  EXPECT_EQ(polled_at(208), "");
  EXPECT_EQ(calls_.next_deadline(), at(220));
}

}  // namespace
}  // namespace interpolated_motion::node
