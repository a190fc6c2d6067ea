#include "hardware/host_stall.h"
#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

hardware::BusConfiguration with_heartbeat(hardware::BusConfiguration bus, double timeout) {
  bus.heartbeat_timeout = timeout;
  return bus;
}

axis::EposAxisParameters impatient(axis::EposAxisParameters p, double heartbeat_timeout) {
  p.heartbeat_timeout = p.host_watch = host_duration(heartbeat_timeout);
  p.feedback_timeout = milliseconds(250);
  return p;
}

class EposHostStall : public HostStall {
 protected:
  explicit EposHostStall(double heartbeat_timeout = 0.5)
      : HostStall(with_heartbeat(bus_configuration(false), heartbeat_timeout)),
        axis(impatient(axis_parameters<axis::EposAxisParameters>(), heartbeat_timeout), link.master(),
             link.master().add_node(1)) {}

  void SetUp() override {
    drive_.set_sample_observer([this](const emulation::EposSample& sample) { take(sample); });
    prepare(axis, there());
    axis.arm(now(), now());
    link.signal(now());
    run(0.7);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }

  /// At each sample of the drive.
  void take(const emulation::EposSample& sample) {
    if (sample.interpolating) compare(sample.demand, 1e-3 * static_cast<double>(sample.samples_since_start));
  }

  emulation::EposDrive& drive_ =
      world_.add<emulation::EposDrive>(bus_, drive_parameters<emulation::EposParameters>());
  axis::EposAxis axis;
};

// The FIFO lasts longer, and neither side has missed the other's heartbeat. That no position came meanwhile
// is the host's doing.
TEST_F(EposHostStall, OfLessThanTheHeartbeatTimeoutCostsNothing) {
  for (int i = 0; i < 3; ++i) {
    stall(milliseconds(400));
    run(0.2);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  EXPECT_TRUE(axis.finished());
  EXPECT_LE(worst_, 1.0);
  EXPECT_NEAR(drive_.position(), 2.0 * kCounts, 1.0);
}

// The drive has last heard the host up to 0.1 s before the stall, so it brakes 1.1 to 1.2 s after the start,
// at 0.6 to 0.7 rad and 1 rad/s, and stands 0.05 rad further on; the path would have taken it to 0.9 rad by
// the time the host wakes.
TEST_F(EposHostStall, BeyondTheHeartbeatTimeoutStopsTheDriveByItself) {
  stall(milliseconds(700));
  const double stopped = drive_.position() / kCounts;
  EXPECT_GT(stopped, 0.63);
  EXPECT_LT(stopped, 0.77);
  run(0.05);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("0x8130"), std::string::npos) << axis.fault_text();
  run(1.0);
  EXPECT_NEAR(drive_.position(), stopped * kCounts, 1.0);
}

TEST_F(EposHostStall, ASilentDriveIsMissedAfterTheFeedbackTimeout) {
  drive_.silence(true, now());
  const HostTime begin = now();
  ASSERT_TRUE(comes_to(AxisState::FaultStopping));
  EXPECT_NEAR(seconds(now() - begin), 0.25, 0.03);
  EXPECT_NE(axis.fault_text().find("no position"), std::string::npos) << axis.fault_text();
  ASSERT_TRUE(run_until([&] { return axis.state() != AxisState::FaultStopping; }));
  const double stopped = drive_.position();
  run(0.5);
  EXPECT_NEAR(drive_.position(), stopped, 1.0) << "the fault was over before the drive stood";
}

class EposPatientHostStall : public EposHostStall {
 protected:
  EposPatientHostStall() : EposHostStall(60.0) {}
};

// What the host is away for does not count, but nor does it make the rest forgotten: 0.3 s there are enough.
TEST_F(EposPatientHostStall, ASilentDriveIsMissedThoughTheHostIsAwayAgainAndAgain) {
  drive_.silence(true, now());
  for (int i = 0; i < 3; ++i) {
    stall(milliseconds(150));
    run(0.05);
  }
  EXPECT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  for (int i = 0; i < 3; ++i) {
    stall(milliseconds(150));
    run(0.05);
  }
  EXPECT_EQ(axis.state(), AxisState::FaultStopping);
  EXPECT_NE(axis.fault_text().find("no position"), std::string::npos) << axis.fault_text();
}

}  // namespace
}  // namespace interpolated_motion::test
