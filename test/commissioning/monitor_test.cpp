#include "interpolated_motion_driver/commissioning/monitor.h"

#include <gtest/gtest.h>

#include "bench.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

namespace interpolated_motion::commissioning {
namespace {

TEST(Monitor, TellsWhatACanDriveDoes) {
  CanBench bench;
  emulation::EposParameters parameters;
  parameters.node_id = 2;
  parameters.initial_position = 1234;
  auto& drive = bench.world.add<emulation::EposDrive>(bench.bus, parameters);
  bench.session.listen(std::chrono::milliseconds(300));
  CanMonitor monitor(bench.session, {2, 5});
  const auto rows = monitor.look();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].drive, "node 2");
  EXPECT_TRUE(contains(rows[0].state, "switch on disabled"));
  EXPECT_EQ(rows[0].mode, "profile position");  // EPOS2 as delivered, 0x6060
  EXPECT_EQ(rows[0].position, "1234");
  EXPECT_EQ(rows[0].buffer, "0 of 64");
  EXPECT_EQ(rows[0].current, "-");  // no 0x6078 in its EDS
  EXPECT_EQ(rows[0].errors, "none");
  EXPECT_EQ(rows[1].state, "does not answer");

  drive.raise_fault(0x2310, 0x02, bench.world.now());
  bench.session.listen(std::chrono::milliseconds(50));
  const MonitorRow fault = monitor.look()[0];
  EXPECT_TRUE(contains(fault.state, "fault"));
  EXPECT_EQ(fault.errors, "generic, current; last 0x2310 over-current error");
}

TEST(Monitor, AsksOnceForWhatADriveLacks) {
  CanBench bench;
  emulation::EposParameters parameters;
  parameters.node_id = 2;
  bench.world.add<emulation::EposDrive>(bench.bus, parameters);
  bench.session.listen(std::chrono::milliseconds(300));
  CanMonitor monitor(bench.session, {2});
  monitor.look();
  const std::size_t first = bench.requests.size();
  monitor.look();
  // 0x6078, 0x6079 and 0x60F4 are not in the EDS of EPOS2.
  EXPECT_EQ(bench.requests.size() - first, first - 3);
}

TEST(Monitor, TellsWhatALineDriveDoes) {
  LineBench bench;
  emulation::SilverDustParameters parameters;
  parameters.initial_position = 99;
  bench.world.add<emulation::SilverDust>(bench.line, parameters);
  LineMonitor monitor(bench.session, {16, 17});
  const auto rows = monitor.look();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_TRUE(contains(rows[0].state, "at rest; no fault"));
  EXPECT_EQ(rows[0].position, "99");
  EXPECT_EQ(rows[0].deviation, "0");
  EXPECT_EQ(rows[1].state, "does not answer");
  // Command Reference: POL (0) and CPL (1) belong to whom the drive works for.
  for (const std::string& request : bench.requests) {
    EXPECT_FALSE(contains(request + " ", " 0 ")) << request;
    EXPECT_NE(request.substr(request.find(' ') + 1, 2), "1 ") << request;
  }
}

TEST(Monitor, TheTableLeavesOutWhatNobodyTells) {
  MonitorRow first;
  first.drive = "node 2";
  first.position = "-5";
  first.state = "fault";
  MonitorRow second;
  second.drive = "node 10";
  EXPECT_EQ(monitor_table({first, second}),
            "DRIVE    POSITION  STATE\n"
            "node 2   -5        fault\n"
            "node 10  -         -");
}

}  // namespace
}  // namespace interpolated_motion::commissioning
