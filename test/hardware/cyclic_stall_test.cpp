#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic_axis.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/can_link.h"

// A host that stalls: the world goes on, and nobody polls axis and bus.
namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

constexpr double kPi = 3.14159265358979324;
constexpr double kCounts = 1e5 / (2.0 * kPi);  // per rad

hardware::BusConfiguration bus_configuration() {
  hardware::BusConfiguration bus;
  bus.name = "can0";
  bus.isochronous = true;
  return bus;
}

axis::CyclicAxisParameters axis_parameters() {
  axis::CyclicAxisParameters p;
  p.joint = "elbow";
  p.transmission.counts_per_revolution = 1e5;
  p.limits.max_velocity = 2.0;
  p.limits.max_acceleration = 10.0;
  p.limits.min_position = -3.0;
  p.limits.max_position = 3.0;
  return p;
}

emulation::CyclicParameters drive_parameters() {
  emulation::CyclicParameters p;
  p.node_id = 1;
  return p;
}

/// From rest at 0 to 1 rad/s at 0.5 rad within a second, straight on for another, and to rest at 2 rad within
/// a third: the velocity rises as 3 t^2 - 2 t^3.
trajectory::Path there() {
  const trajectory::Polynomial speed_up{{0.0, 0.0, 0.0, 1.0, -0.5, 0.0}};
  const trajectory::Polynomial cruise{{0.5, 1.0, 0.0, 0.0, 0.0, 0.0}};
  const trajectory::Polynomial slow_down{{1.5, 1.0, 0.0, -1.0, 0.5, 0.0}};
  const auto s = [](double t) { return GoalTime{t}; };
  return trajectory::Path({{s(0), s(1), speed_up}, {s(1), s(2), cruise}, {s(2), s(3), slow_down}});
}

class HostStall : public testing::Test {
 protected:
  void SetUp() override {
    drive_.set_sample_observer([this](const emulation::CyclicSample& sample) { take(sample); });
    axis.bring_up(now());
    ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Disabled; })) << axis.fault_text();
    axis.enable(now());
    ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Ready; })) << axis.fault_text();
    const auto refusal = axis.plan(there(), GoalTime{0.0});
    ASSERT_FALSE(refusal) << refusal->text;
    axis.load(now());
    ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Loaded; }));
    begin_ = now() + host_duration(axis.start_lead().count());
    axis.arm(begin_, now());
    run(1.5);  // in the middle of the straight line, just behind a SYNC or anywhere else
    ASSERT_EQ(axis.state(), AxisState::Moving);
    ASSERT_LE(worst_, 5.0);
  }

  HostTime now() const { return world_.now(); }

  void step(HostTime limit) {
    world_.advance(limit);
    link.receive({});
    link.poll(now());
    axis.poll(now());
    link.send(now());
  }

  bool run_until(const std::function<bool()>& condition, double most = 5.0) {
    const HostTime end = now() + host_duration(most);
    while (!condition() && now() < end)
      step(std::min(end, std::max(link.next_deadline(), now() + std::chrono::microseconds(50))));
    return condition();
  }

  void run(double duration) {
    run_until([] { return false; }, duration);
  }

  void run_to_next_sync() {
    const auto syncs = link.master().syncs_confirmed();
    run_until([&] { return link.master().syncs_confirmed() > syncs; });
  }

  void stall(HostDuration duration) {
    const HostTime end = now() + duration;
    while (now() < end) world_.advance(end);
  }

  /// Deviation of the drive from the path at true time, counts.
  void take(const emulation::CyclicSample& sample) {
    if (begin_ == kNever || !sample.following) return;
    const double demand = there().sample(GoalTime{seconds(sample.time - begin_)}).position * kCounts;
    worst_ = std::max(worst_, std::abs(sample.demand - demand));
    last_ = std::abs(sample.demand - demand);
  }

  emulation::World world_;
  transport::VirtualCanBus& bus_ = world_.add_can_bus("can0", 1'000'000);
  emulation::CyclicDrive& drive_ = world_.add_cyclic(bus_, drive_parameters());
  hardware::CanLink link{bus_configuration(), bus_.host()};
  axis::CyclicAxis axis{axis_parameters(), link.master(), link.master().add_node(1)};
  HostTime begin_ = kNever;
  double worst_ = 0.0;
  double last_ = 0.0;
};

// On the straight line a late or lost target position costs nothing but what the drive's grid follows of the
// delay of one SYNC: an eighth of it, at 1 rad/s.
TEST_F(HostStall, LateSyncShiftsTheDriveByAnEighthOfTheDelay) {
  run_to_next_sync();
  run(0.008);
  stall(milliseconds(6));  // the SYNC is 4 ms late
  run(0.2);
  EXPECT_EQ(link.master().sync_timing().skipped(), 0U);
  EXPECT_LE(worst_, 4e-3 / 8.0 * kCounts + 5.0);
  EXPECT_GE(worst_, 0.5 * 4e-3 / 8.0 * kCounts);
  EXPECT_LE(last_, 5.0);
  EXPECT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
}

TEST_F(HostStall, OfTwoPeriodsIsRiddenThrough) {
  run_to_next_sync();
  run(0.002);
  stall(milliseconds(20));
  run(0.1);
  EXPECT_EQ(link.master().sync_timing().skipped(), 2U);
  EXPECT_LE(worst_, 10.0);
  ASSERT_TRUE(run_until([&] { return axis.finished(); })) << axis.fault_text();
  EXPECT_LE(last_, 1.0);
  axis::AxisStatus status;
  axis.status(now(), status);
  EXPECT_GE(status.underruns, 1U);
}

// The drive gives up by itself, and the host finds it in fault when it wakes.
TEST_F(HostStall, BeyondTheRideThroughStopsTheDriveByItself) {
  run_to_next_sync();
  stall(milliseconds(300));
  const double stopped = drive_.position();
  run(0.05);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("0x8700"), std::string::npos) << axis.fault_text();
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
  axis.reset_fault(now());
  ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Disabled; })) << axis.fault_text();
  axis.enable(now());
  ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Ready; })) << axis.fault_text();
  run(0.5);
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
}

TEST_F(HostStall, ToldTooLateTheAxisDoesNotStart) {
  ASSERT_TRUE(run_until([&] { return axis.finished() && axis.state() == AxisState::Ready; }));
  begin_ = kNever;
  const trajectory::Path back({{GoalTime{0}, GoalTime{2}, {{2.0, 0.0, 0.0, -2.5, 1.875, -0.375}}}});
  const auto refusal = axis.plan(back, GoalTime{0.0});
  ASSERT_FALSE(refusal) << refusal->text;
  axis.load(now());
  ASSERT_TRUE(run_until([&] { return axis.state() == AxisState::Loaded; }));
  const double rest = drive_.position();
  axis.arm(now() + milliseconds(5), now());
  run(0.5);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("stalled"), std::string::npos) << axis.fault_text();
  EXPECT_NEAR(drive_.position(), rest, 1.0);
}

}  // namespace
}  // namespace interpolated_motion::test
