#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/serial_link.h"
#include "interpolated_motion_driver/trajectory/path.h"

// The host is away: the world goes on, and nobody polls axis and line. What a drive has in its queue does not
// depend on that, and what the host did not hear meanwhile is no silence of the drive.
namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

constexpr double kCounts = 4000.0 * 50.0 / (2.0 * 3.14159265358979324);  // per rad

class SilverlodeHostStall : public testing::Test {
 protected:
  /// From rest to 0.2 rad/s within a second, straight on for `cruise`, and to rest within a second: the
  /// velocity rises as 3 t^2 - 2 t^3.
  static trajectory::Path there(double cruise = 8.0) {
    const double v = 0.2;
    const auto s = [](double t) { return GoalTime{t}; };
    const trajectory::Polynomial speed_up{{0.0, 0.0, 0.0, v, -0.5 * v, 0.0}};
    const trajectory::Polynomial straight{{0.5 * v, v, 0.0, 0.0, 0.0, 0.0}};
    const trajectory::Polynomial slow_down{{(0.5 + cruise) * v, v, 0.0, -v, 0.5 * v, 0.0}};
    return trajectory::Path(
        {{s(0), s(1), speed_up}, {s(1), s(1 + cruise), straight}, {s(1 + cruise), s(2 + cruise), slow_down}});
  }

  static hardware::BusConfiguration line_configuration() {
    hardware::BusConfiguration bus;
    bus.name = "line0";
    return bus;
  }

  static axis::SilverlodeAxisParameters axis_parameters() {
    axis::SilverlodeAxisParameters p;
    p.joint = "elbow";
    p.transmission.counts_per_revolution = 4000.0;
    p.transmission.ratio = 50.0;
    p.limits.max_velocity = 2.0;
    p.limits.max_acceleration = 10.0;
    p.limits.min_position = -3.0;
    p.limits.max_position = 3.0;
    p.commit_horizon = 5.0;
    return p;
  }

  HostTime now() const { return world_.now(); }

  void step(HostTime limit) {
    world_.advance(limit);
    link.receive({});
    link.poll(now());
    axis.poll(now());
    link.send(now());
  }

  bool run_until(const std::function<bool()>& condition, double most = 15.0) {
    const HostTime end = now() + host_duration(most);
    while (!condition() && now() < end) {
      const HostTime next = std::min(link.next_deadline(), axis.next_deadline());
      step(std::min(end, std::max(next, now() + std::chrono::microseconds(50))));
    }
    return condition();
  }

  bool comes_to(AxisState state) {
    return run_until([&] { return axis.state() == state; });
  }

  void run(double duration) {
    run_until([] { return false; }, duration);
  }

  void stall(HostDuration duration) {
    const HostTime end = now() + duration;
    while (now() < end) world_.advance(end);
  }

  void prepare() {
    axis.bring_up(now());
    ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
    axis.enable(now());
    ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  }

  /// Until `for_seconds` after the begin of the path.
  void move(double for_seconds, double cruise = 8.0) {
    prepare();
    auto tail = axis.encoder_at_rest(axis.rest_position(), GoalTime{0.0})->encode(there(cruise));
    ASSERT_TRUE(tail) << tail.error().text;
    axis.load(std::move(tail.value()), now());
    ASSERT_TRUE(comes_to(AxisState::Loaded)) << axis.fault_text();
    const HostTime begin = now() + host_duration(axis.start_lead().count());
    axis.arm(begin, now());
    run(seconds(begin - now()) + for_seconds);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }

  double queued() {
    axis::AxisStatus status;
    axis.status(now(), status);
    return status.fill_time;
  }

  void expect_the_whole_way(double cruise = 8.0) {
    ASSERT_TRUE(run_until([&] { return axis.state() != AxisState::Moving; })) << axis.fault_text();
    EXPECT_EQ(axis.state(), AxisState::Ready) << axis.fault_text();
    EXPECT_TRUE(axis.finished());
    EXPECT_NEAR(drive_.position(), (1.0 + cruise) * 0.2 * kCounts, 1.0);
  }

  emulation::World world_;
  transport::VirtualSerialLine& line_ = world_.add_serial_line("line0");
  hardware::SerialLink link{line_configuration(), line_.host()};
  emulation::SilverDust& drive_ = world_.add<emulation::SilverDust>(line_, emulation::SilverDustParameters{});
  axis::SilverlodeAxis axis{axis_parameters(), link.master(), link.master().add_device(16)};
};

class SilverlodeHostAway : public SilverlodeHostStall, public testing::WithParamInterface<int> {};

TEST_P(SilverlodeHostAway, ForLessThanItsQueueLastsCostsNothing) {
  move(2.0);
  ASSERT_GE(queued(), 3.0);
  stall(milliseconds(GetParam()));
  run(0.5);
  EXPECT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  expect_the_whole_way();
}

TEST_P(SilverlodeHostAway, AgainAndAgainCostsNothing) {
  move(2.0);
  for (int i = 0; i < 3; ++i) {
    stall(milliseconds(GetParam()));
    run(0.8);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }
  expect_the_whole_way();
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, SilverlodeHostAway, testing::Values(900, 1050, 1200));

// The drive comes to the end of its motion and stands, and the host learns of it later than it would have
// waited for.
TEST_F(SilverlodeHostStall, AtTheEndOfTheMotionIsNoOvertimeOfTheDrive) {
  move(3.7, 2.0);
  stall(milliseconds(1500));
  expect_the_whole_way(2.0);
}

TEST_F(SilverlodeHostStall, AfterAStopWasCommandedTheStopGoesOn) {
  move(2.0);
  axis.stop(now());
  run(0.003);
  stall(milliseconds(3500));
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
}

TEST_F(SilverlodeHostStall, DuringBringUpIsNoSilenceOfTheDrive) {
  axis.bring_up(now());
  run(0.02);
  stall(milliseconds(6000));
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
}

// What was asked for before the host was away has not been on the line yet: that is not the line's fault.
TEST_F(SilverlodeHostStall, WithACommandNotYetSentIsNoFaultOfTheLine) {
  prepare();
  axis.disable(now());
  stall(milliseconds(3500));
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
}

// A drive that is booting while the host is away gets the time it was promised.
TEST_F(SilverlodeHostStall, WhileTheDriveBootsDoesNotUseUpTheTimeForBringUp) {
  drive_.power_cycle(now(), milliseconds(6500));
  axis.bring_up(now());
  run(0.1);
  stall(milliseconds(5500));
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
}

// What the host is away for does not count, but nor does it make the rest forgotten.
TEST_F(SilverlodeHostStall, ASilentDriveIsStillMissed) {
  move(2.0);
  drive_.silence(true, now());
  stall(milliseconds(1200));
  const HostTime awake = now();
  ASSERT_TRUE(run_until([&] { return axis.state() != AxisState::Moving; }, 2.0));
  EXPECT_LE(seconds(now() - awake), 1.0 + 0.05);
  EXPECT_EQ(axis.state(), AxisState::FaultStopping);
}

}  // namespace
}  // namespace interpolated_motion::test
