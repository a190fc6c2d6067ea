#include <string>

#include <gtest/gtest.h>

#include "hardware/host_stall.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"
#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

// The host is away from drives on CAN that would wait for it: what it did not hear meanwhile is no silence of
// theirs, and no time limit of theirs runs.
namespace interpolated_motion::test {
namespace {

using axis::AxisState;
using std::chrono::milliseconds;

constexpr double kPatience = 60.0;  ///< s, of drive and host with each other's heartbeat

hardware::BusConfiguration patient(hardware::BusConfiguration bus) {
  bus.heartbeat_timeout = kPatience;
  return bus;
}

template <class Parameters>
Parameters patient_axis(Parameters p) {
  p.heartbeat_timeout = host_duration(kPatience);
  return p;
}

axis::EposAxisParameters patient_epos(axis::EposAxisParameters p) {
  p.commit_horizon = 2.0;
  p.host_watch = host_duration(kPatience);
  return patient_axis(p);
}

class EposHostAway : public HostStall {
 protected:
  EposHostAway() : HostStall(patient(bus_configuration(false))) {}

  void move(double for_seconds) {
    prepare(axis, there());
    axis.arm(now(), now());
    link.signal(now());
    run(for_seconds);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }

  emulation::EposDrive& drive_ =
      world_.add<emulation::EposDrive>(bus_, drive_parameters<emulation::EposParameters>());
  axis::EposAxis axis{patient_epos(axis_parameters<axis::EposAxisParameters>()), link.master(),
                      link.master().add_node(1)};
};

TEST_F(EposHostAway, ForLessThanItsFifoLastsCostsNothing) {
  move(0.7);
  stall(milliseconds(1200));
  run(0.2);
  EXPECT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  EXPECT_TRUE(axis.finished());
  EXPECT_NEAR(drive_.position(), 2.0 * kCounts, 1.0);
}

TEST_F(EposHostAway, AtTheEndOfTheMotionIsNoOvertimeOfTheDrive) {
  move(2.5);
  stall(milliseconds(2000));
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  EXPECT_TRUE(axis.finished());
}

TEST_F(EposHostAway, AfterAStopWasCommandedTheStopGoesOn) {
  move(0.7);
  axis.stop(now());
  link.signal(now());
  run(0.003);
  stall(milliseconds(3000));
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
}

TEST_F(EposHostAway, AtRestCostsNothing) {
  prepare(axis, there());
  axis.stop(now());
  ASSERT_TRUE(comes_to(AxisState::Ready)) << axis.fault_text();
  stall(milliseconds(3000));
  run(0.5);
  EXPECT_EQ(axis.state(), AxisState::Ready) << axis.fault_text();
}

// A drive that is booting while the host is away gets the time it was promised.
TEST_F(EposHostAway, WhileTheDriveBootsDoesNotUseUpTheTimeForBringUp) {
  drive_.power_cycle(now(), milliseconds(7500));
  axis_ = &axis;
  axis.bring_up(now());
  run(0.1);
  stall(milliseconds(5500));
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
}

class CyclicHostAway : public HostStall {
 protected:
  CyclicHostAway() : HostStall(patient(bus_configuration(true))) {}

  void move(double for_seconds) {
    prepare(axis, there());
    const HostTime begin = now() + host_duration(axis.start_lead().count());
    axis.arm(begin, now());
    run(for_seconds);
    ASSERT_EQ(axis.state(), AxisState::Moving) << axis.fault_text();
  }

  emulation::CyclicDrive& drive_ =
      world_.add<emulation::CyclicDrive>(bus_, drive_parameters<emulation::CyclicParameters>());
  axis::CyclicAxis axis{patient_axis(axis_parameters<axis::CyclicAxisParameters>()), link.master(),
                        link.master().add_node(1)};
};

TEST_F(CyclicHostAway, WhileTheDriveBootsDoesNotUseUpTheTimeForBringUp) {
  drive_.power_cycle(now(), milliseconds(7500));
  axis_ = &axis;
  axis.bring_up(now());
  run(0.1);
  stall(milliseconds(5500));
  ASSERT_TRUE(comes_to(AxisState::Disabled)) << axis.fault_text();
}

// It rides on without target positions for a while, then brakes: only then is the fault over.
TEST_F(CyclicHostAway, AFaultOfADriveThatIsNotHeardIsOverWhenItMustStand) {
  move(1.5);
  drive_.silence(true, now());
  ASSERT_TRUE(comes_to(AxisState::FaultStopping)) << axis.fault_text();
  EXPECT_NE(axis.fault_text().find("no position"), std::string::npos) << axis.fault_text();
  ASSERT_TRUE(run_until([&] { return axis.state() != AxisState::FaultStopping; }));
  EXPECT_EQ(axis.state(), AxisState::Fault);
  EXPECT_NE(axis.fault_text().find("not been seen at rest"), std::string::npos) << axis.fault_text();
  const double stopped = drive_.position();
  run(0.5);
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
}

TEST_F(CyclicHostAway, AFaultOfADriveThatIsHeardIsOverWhenItIsSeenToStand) {
  move(1.5);
  drive_.raise_fault(0x2310, 0x01, now());
  ASSERT_TRUE(comes_to(AxisState::FaultStopping)) << axis.fault_text();
  ASSERT_TRUE(comes_to(AxisState::Fault)) << axis.fault_text();
  EXPECT_NE(axis.fault_text().find("has come to rest"), std::string::npos) << axis.fault_text();
  const double stopped = drive_.position();
  run(0.5);
  EXPECT_NEAR(drive_.position(), stopped, 1.0);
}

}  // namespace
}  // namespace interpolated_motion::test
