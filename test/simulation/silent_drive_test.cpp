#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/script.h"
#include "simulation/simulation.h"

// A cyclic drive neither hears nor answers for some periods, in motion: an EPOS drive keeps the bus alive.
namespace interpolated_motion::simulation {
namespace {

constexpr char kArm[] =
    "configuration {joints: [joint1, joint2], buses: {can0: {type: canopen}}, drives: {"
    "joint1: {bus: can0, type: epos_ipm, node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, limits: "
    "{max_acceleration: 20}}, "
    "joint2: {bus: can0, type: cyclic, node_id: 2, counts_per_revolution: 4000, gear_ratio: 100, limits: "
    "{max_acceleration: 10}}}}\n"
    "at 0.5 goal points=5 shape=2 effort=0.6 reach=1 noise=4\n";

/// It hears again `before` s before a SYNC. The emulated drive is ready, and SYNC is due, each 10 ms of the
/// script's time after `kSync`.
std::string silence(double begin, double duration) {
  return kArm + fmt::format("at {:.4f} inject joint2 silence 1\nat {:.4f} inject joint2 silence 0\n", begin,
                            begin + duration);
}

// Within the last millisecond before a SYNC the drive takes what it had when it fell silent, and nobody can
// help that: of ten instants, a millisecond apart, that is one.
TEST(SilentDrive, IsLedBackWithinItsLimits) {
  int violated = 0;
  int runs = 0;
  for (double duration : {0.024, 0.034}) {
    for (double begin = 0.7; begin < 0.7095; begin += 0.001, ++runs) {
      const Outcome outcome = simulate(parse_script(silence(begin, duration)));
      if (outcome.violation) ++violated;
    }
  }
  EXPECT_EQ(runs, 20);
  EXPECT_LE(violated, 2);
}

}  // namespace
}  // namespace interpolated_motion::simulation
