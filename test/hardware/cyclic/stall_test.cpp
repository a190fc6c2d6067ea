#include "hardware/host_stall.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"

namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

class CyclicHostStall : public HostStall {
 protected:
  CyclicHostStall() : HostStall(bus_configuration(true)) {}

  void SetUp() override {
    drive_.set_sample_observer([this](const emulation::CyclicSample& sample) { take(sample); });
    prepare(axis, there());
    begin_ = now() + host_duration(axis.start_lead().count());
    axis.arm(begin_, now());
    run(1.5);  // in the middle of the straight line, just behind a SYNC or anywhere else
    ASSERT_EQ(axis.state(), AxisState::Moving);
    ASSERT_LE(worst_, 5.0);
  }

  void run_to_next_sync() {
    const auto syncs = link.master().syncs_confirmed();
    run_until([&] { return link.master().syncs_confirmed() > syncs; });
  }

  /// At true time.
  void take(const emulation::CyclicSample& sample) {
    if (begin_ != kNever && sample.following) compare(sample.demand, seconds(sample.time - begin_));
  }

  emulation::CyclicDrive& drive_ =
      world_.add<emulation::CyclicDrive>(bus_, drive_parameters<emulation::CyclicParameters>());
  axis::CyclicAxis axis{axis_parameters<axis::CyclicAxisParameters>(), link.master(),
                        link.master().add_node(1)};
  HostTime begin_ = kNever;
};

// On the straight line a late or lost target position costs nothing but what the drive's grid follows of the
// delay of one SYNC: an eighth of it, at 1 rad/s.
TEST_F(CyclicHostStall, LateSyncShiftsTheDriveByAnEighthOfTheDelay) {
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

TEST_F(CyclicHostStall, OfTwoPeriodsIsRiddenThrough) {
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
TEST_F(CyclicHostStall, BeyondTheRideThroughStopsTheDriveByItself) {
  run_to_next_sync();
  stall(milliseconds(300));
  const double stopped = drive_.position();
  run(0.05);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("0x8700"), std::string::npos) << axis.fault_text();
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
  axis.reset_fault(now());
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
  axis.enable(now());
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  run(0.5);
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
}

TEST_F(CyclicHostStall, ToldTooLateTheAxisDoesNotStart) {
  ASSERT_TRUE(run_until([&] { return axis.finished() && axis.state() == AxisState::Ready; }));
  begin_ = kNever;
  const trajectory::Path back({{GoalTime{0}, GoalTime{2}, {{2.0, 0.0, 0.0, -2.5, 1.875, -0.375}}}});
  load(back);
  const double rest = drive_.position();
  axis.arm(now() + milliseconds(5), now());
  run(0.5);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("stalled"), std::string::npos) << axis.fault_text();
  EXPECT_NEAR(drive_.position(), rest, 1.0);
}

}  // namespace
}  // namespace interpolated_motion::test
