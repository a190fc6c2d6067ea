#include "hardware/host_stall.h"
#include "interpolated_motion_driver/axis/epos_axis.h"

namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

emulation::EposParameters drive_parameters() {
  emulation::EposParameters p;
  p.node_id = 1;
  return p;
}

axis::EposAxisParameters impatient(axis::EposAxisParameters p) {
  p.feedback_timeout = milliseconds(250);
  return p;
}

class EposHostStall : public HostStall {
 protected:
  EposHostStall() : HostStall(bus_configuration(false)) {}

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

  emulation::EposDrive& drive_ = world_.add_epos(bus_, drive_parameters());
  axis::EposAxis axis{impatient(axis_parameters<axis::EposAxisParameters>()), link.master(),
                      link.master().add_node(1)};
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

// The drive brakes by itself, and the host finds it in fault when it wakes.
TEST_F(EposHostStall, BeyondTheHeartbeatTimeoutStopsTheDriveByItself) {
  stall(milliseconds(700));
  const double stopped = drive_.position();
  EXPECT_LT(stopped, 1.2 * kCounts) << "on the path it would be at 1.1 rad, and go on";
  run(0.05);
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("0x8130"), std::string::npos) << axis.fault_text();
  run(1.0);
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
}

TEST_F(EposHostStall, ASilentDriveIsMissedAfterTheFeedbackTimeout) {
  drive_.silence(true, now());
  const HostTime begin = now();
  ASSERT_TRUE(comes_to(AxisState::Fault));
  EXPECT_NEAR(seconds(now() - begin), 0.25, 0.03);
  EXPECT_NE(axis.fault_text().find("no position"), std::string::npos) << axis.fault_text();
}

}  // namespace
}  // namespace interpolated_motion::test
