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
    constexpr double kSampleSquared = 1e-6;  // s^2
    const double rise = sample.demand - former_demand_;
    if (++samples_ > 2) {
      const double acceleration = std::abs(rise - former_rise_) / kSampleSquared;
      worst_acceleration_ = std::max(worst_acceleration_, acceleration);
    }
    former_demand_ = sample.demand;
    former_rise_ = rise;
  }

  /// counts/s^2: limit_margin times the limit, and what whole counts make of cubics: the velocities of two
  /// that meet differ by up to 8 counts / 3 periods, and each bends by up to 2 counts / period^2.
  static double most_acceleration() {
    return 1.2 * 10.0 * kCounts + 8.0 / (3.0 * 0.01 * 0.001) + 2.0 / (0.01 * 0.01);
  }

  emulation::CyclicDrive& drive_ =
      world_.add<emulation::CyclicDrive>(bus_, drive_parameters<emulation::CyclicParameters>());
  axis::CyclicAxis axis{axis_parameters<axis::CyclicAxisParameters>(), link.master(),
                        link.master().add_node(1)};
  HostTime begin_ = kNever;
  std::uint64_t samples_ = 0;
  double former_demand_ = 0.0;
  double former_rise_ = 0.0;
  double worst_acceleration_ = 0.0;  ///< counts/s^2, of the drive's demand from sample to sample
};

// The drive goes on along its cubic over the period without SYNC. Through whole counts, each half a count off
// at most, that is off by up to 49 / 2 counts where the next target position is reached (10, 20, 15 and 4
// times the last four), and the way back begins there. SYNC is on the bus 52 us late at most, 0.8 counts at 1
// rad/s.
TEST_F(CyclicHostStall, LateSyncIsLeftOutAndTheDriveGoesOn) {
  run_to_next_sync();
  run(0.008);
  stall(milliseconds(6));  // the SYNC is 4 ms late
  run(0.2);
  EXPECT_EQ(link.master().sync_timing().skipped(), 1U);
  EXPECT_LE(worst_, 25.0);
  EXPECT_LE(last_, 2.0);
  EXPECT_LE(worst_acceleration_, most_acceleration());
  EXPECT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  axis::AxisStatus status;
  axis.status(now(), status);
  EXPECT_EQ(status.underruns, 1U);
}

// Within half a period and beyond: on the line, bent, just before the end and behind it.
TEST_F(CyclicHostStall, LateSyncKeepsTheLimitOfAccelerationWhereverItComes) {
  int late = 0;
  for (const double until : {1.6, 1.75, 1.97, 2.1, 2.2, 2.4, 2.5, 2.6, 2.7, 2.8, 2.96, 3.02}) {
    run(until - seconds(now() - begin_));
    run_to_next_sync();
    run(0.008);
    late = late % 7 + 3;  // ms: 3, 6, 9, 5, 8, 4, 7, ...
    stall(milliseconds(2 + late));
    run(0.003);
    EXPECT_LE(worst_acceleration_, most_acceleration()) << until << " s, " << late << " ms late";
    EXPECT_EQ(axis.fault_text(), "");
  }
  ASSERT_TRUE(run_until([&] { return axis.finished(); })) << axis.fault_text();
  EXPECT_LE(last_, 1.0);
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

// Target positions go on at rest, but they are no more of the motion.
TEST_F(CyclicHostStall, AtRestIsNotReportedOfTheMotionBefore) {
  ASSERT_TRUE(run_until([&] { return axis.finished() && axis.state() == AxisState::Ready; }));
  const axis::AxisReport ended = axis.report();
  EXPECT_EQ(ended.underruns, 0U);
  run_to_next_sync();
  run(0.008);
  stall(milliseconds(6));
  run(0.1);
  EXPECT_EQ(link.master().sync_timing().skipped(), 1U);
  EXPECT_EQ(axis.report().underruns, 0U);
  EXPECT_EQ(axis.report().records_sent, ended.records_sent);
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
