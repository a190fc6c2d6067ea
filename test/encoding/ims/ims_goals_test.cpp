#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/ims/ims_executor.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"

namespace interpolated_motion::encoding {
namespace {

using testing::execute_segments;
using testing::goal_paths;
using testing::ims_encoding;
using testing::Order;
using testing::rounded_start;

std::string goal_file(const std::string& name) {
  return std::string(IMD_SOURCE_DIR) + "/config/goals/" + name;
}

class ImsGoalFile : public ::testing::TestWithParam<const char*> {};

TEST_P(ImsGoalFile, EveryAxisKeepsTheBoundAtEveryTickAndEndsOnTheCount) {
  const ImsEncoding encoding = ims_encoding();
  for (const trajectory::Path& path : goal_paths(goal_file(GetParam()))) {
    const auto stream = encode_ims(path, encoding, rounded_start(path, encoding));
    ASSERT_TRUE(stream) << stream.error().text;
    const auto& segments = stream.value().segments;
    const auto execution = execute_segments(segments, stream.value().start_counts, path, encoding);
    EXPECT_LE(execution.worst_deviation, 2.0 + 1e-3);
    EXPECT_LE(execution.peak_rpm, encoding.max_motor_rpm);
    EXPECT_LE(execution.peak_acceleration, encoding.max_motor_acceleration);
    EXPECT_EQ(execution.end, std::round(encoding.transmission.counts(path.final_position())));
    EXPECT_EQ(execution.end_velocity, 0.0);
    EXPECT_LE(execution.snap, 0.05);
    EXPECT_EQ(ServoTicks(execution.ticks), stream.value().duration);
    EXPECT_EQ(stream.value().terminator.time, 0);
    EXPECT_EQ(stream.value().terminator.position, segments.back().position);
  }
}

TEST_P(ImsGoalFile, TheOrderOfVelocityAndPositionShiftsTheMotionByHalfATickOnly) {
  const ImsEncoding encoding = ims_encoding();
  for (const trajectory::Path& path : goal_paths(goal_file(GetParam()))) {
    const auto stream = encode_ims(path, encoding, rounded_start(path, encoding));
    ASSERT_TRUE(stream) << stream.error().text;
    for (const Order order : {Order::VelocityFirst, Order::PositionFirst}) {
      const auto execution = execute_segments(stream.value().segments, stream.value().start_counts, path,
                                              encoding, order, 1.0, testing::ticks_ahead(order));
      EXPECT_LE(execution.worst_deviation, 2.0 + 0.05);
      EXPECT_EQ(execution.end, std::round(encoding.transmission.counts(path.final_position())));
      EXPECT_EQ(execution.end_velocity, 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Goals, ImsGoalFile,
                         ::testing::Values("six_axis_toppra_100ms_pva.yaml", "six_axis_toppra_100ms_pv.yaml",
                                           "six_axis_toppra_20ms_pva.yaml"));

/// Segments that take the path's velocity every 50 ms and hold it: what a host does that knows no better.
std::vector<ImsSegment> sampled_velocities(const trajectory::Path& path, const ImsEncoding& encoding) {
  std::vector<ImsSegment> segments;
  constexpr double kPeriod = 0.05;
  const double units_per_rpm = 2147483648.0 / 4000;
  double before = 0.0;
  for (GoalTime time = path.start_time(); time < path.end_time(); time += GoalTime(kPeriod)) {
    const GoalTime next = std::min(time + GoalTime(kPeriod), path.end_time());
    const double rpm =
        next < path.end_time() ? encoding.transmission.motor_rpm(path.sample(next).velocity) : 0.0;
    const auto tick_of = [&](GoalTime t) { return std::lround((t - path.start_time()).count() / 120e-6); };
    const auto ticks = static_cast<std::int32_t>(tick_of(next) - tick_of(time));
    if (ticks == 0) continue;
    const bool backwards = (rpm != 0.0 ? rpm : before) < 0;
    const double change = std::abs(rpm - before) * units_per_rpm / ticks;
    segments.push_back({ticks, backwards ? -(1 << 30) : 1 << 30,
                        static_cast<std::int32_t>(std::lround(2 * change)),
                        static_cast<std::int32_t>(std::lround(std::abs(rpm) * units_per_rpm))});
    before = rpm;
  }
  return segments;
}

/// Prints the table of segments per axis. Fewer than 108, what meeting position and velocity of the path at
/// every knot takes at 1 count, is held.
TEST(ImsSegmentCount, IsBelowThatOfKnotsOnThePath) {
  std::printf(
      "axis  velocity each 50 ms   error (counts)   bound 1: segments   error   bound 2: segments   error\n");
  int axis = 0;
  for (const trajectory::Path& path : goal_paths(goal_file("six_axis_toppra_100ms_pva.yaml"))) {
    ImsEncoding encoding = ims_encoding();
    const std::int32_t start = rounded_start(path, encoding);
    const auto sampled = sampled_velocities(path, encoding);
    const double drift = execute_segments(sampled, start, path, encoding).worst_deviation;
    std::printf("%4d  %19zu  %15.2f", ++axis, sampled.size(), drift);
    for (const double bound : {1.0, 2.0}) {
      encoding.bound_counts = bound;
      const auto stream = encode_ims(path, encoding, start);
      ASSERT_TRUE(stream) << stream.error().text;
      const auto execution = execute_segments(stream.value().segments, start, path, encoding);
      std::printf("  %18zu  %6.3f", stream.value().segments.size(), execution.worst_deviation);
      EXPECT_LE(execution.worst_deviation, bound + 1e-3);
      EXPECT_LT(execution.worst_deviation, drift);
      EXPECT_LT(stream.value().segments.size(), 108u);
      EXPECT_LT(stream.value().segments.size(), sampled.size());
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace interpolated_motion::encoding
