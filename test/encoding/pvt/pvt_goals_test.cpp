#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/pvt/pvt_executor.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"

namespace interpolated_motion::encoding {
namespace {

using testing::BasisSegment;
using testing::execute_records;
using testing::goal_paths;
using testing::rounded_start;
using testing::six_axis_encoding;

std::string goal_file(const std::string& name) {
  return std::string(IMD_SOURCE_DIR) + "/config/goals/" + name;
}

/// Records on a grid of `grid` ms with every knot rounded to nearest.
std::vector<PvtRecord> uniform_records(const trajectory::Path& path, const PvtEncoding& encoding, int grid) {
  const auto end =
      static_cast<std::int64_t>(std::ceil((path.end_time() - path.start_time()).count() * 1000 - 1e-6));
  std::vector<PvtRecord> records;
  for (std::int64_t from = 0; from < end; from += grid) {
    const auto to = std::min<std::int64_t>(end, from + grid);
    const auto state =
        path.sample(std::min<GoalTime>(path.end_time(), path.start_time() + DriveMilliseconds(to)));
    const double rpm = to == end ? 0.0 : encoding.transmission.motor_rpm(state.velocity);
    records.push_back({static_cast<std::int32_t>(std::lround(encoding.transmission.counts(state.position))),
                       static_cast<std::int32_t>(std::lround(rpm / encoding.velocity_unit_rpm)),
                       static_cast<std::uint8_t>(to - from)});
  }
  return records;
}

/// The fewest records of any uniform grid that keeps the bound, 0 if there is none.
std::size_t best_uniform(const trajectory::Path& path, const PvtEncoding& encoding) {
  const PvtKnot start{0, rounded_start(path, encoding), 0};
  for (int grid = 100; grid > 0; --grid) {
    const auto records = uniform_records(path, encoding, grid);
    if (execute_records(records, start, path, encoding).worst_deviation <= encoding.bound_counts) {
      return records.size();
    }
  }
  return 0;
}

void expect_executable(const trajectory::Path& path, const PvtEncoding& encoding, const PvtStream& stream) {
  const auto execution = execute_records(stream.records, {0, stream.start_counts, 0}, path, encoding);
  EXPECT_LE(execution.worst_deviation, encoding.bound_counts + 1e-6);
  EXPECT_NEAR(execution.worst_deviation, stream.worst_deviation_counts(), 1e-6);
  EXPECT_LE(execution.peak_rpm, encoding.max_motor_rpm);
  EXPECT_LE(execution.peak_acceleration, encoding.max_motor_acceleration);
  EXPECT_EQ(DriveMilliseconds(execution.duration_ms), stream.duration);
  EXPECT_EQ(execution.duration_ms, std::ceil((path.end_time() - path.start_time()).count() * 1000 - 1e-6));
  EXPECT_EQ(stream.records.back().position, std::lround(encoding.transmission.counts(path.final_position())));
  EXPECT_EQ(stream.records.back().velocity, 0);
}

class GoalFile : public ::testing::TestWithParam<const char*> {};

TEST_P(GoalFile, EveryAxisKeepsTheBoundAtEveryVelocityUnit) {
  for (const double unit : {1.0, 0.1, 0.01, 0.001}) {
    const PvtEncoding encoding = six_axis_encoding(unit);
    for (const trajectory::Path& path : goal_paths(goal_file(GetParam()))) {
      const auto stream = encode_pvt(path, encoding, rounded_start(path, encoding));
      ASSERT_TRUE(stream) << stream.error().text;
      expect_executable(path, encoding, stream.value());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Goals, GoalFile,
                         ::testing::Values("six_axis_toppra_100ms_pva.yaml", "six_axis_toppra_100ms_pv.yaml",
                                           "six_axis_toppra_20ms_pva.yaml"));

/// Prints the table of records per axis, and holds the encoder to 0.4 of the best uniform grid at the same
/// bound.
class RecordCount : public ::testing::TestWithParam<double> {};

TEST_P(RecordCount, IsAFractionOfTheBestUniformGrid) {
  const PvtEncoding encoding = six_axis_encoding(GetParam());
  std::printf("velocity unit %g rpm, bound %g counts\naxis  10 ms grid  best uniform  knots chosen  ratio\n",
              encoding.velocity_unit_rpm, encoding.bound_counts);
  int axis = 0;
  for (const trajectory::Path& path : goal_paths(goal_file("six_axis_toppra_100ms_pva.yaml"))) {
    const std::size_t fixed = uniform_records(path, encoding, 10).size();
    const std::size_t uniform = best_uniform(path, encoding);
    const std::size_t chosen =
        encode_pvt(path, encoding, rounded_start(path, encoding)).value().records.size();
    const double ratio = static_cast<double>(chosen) / static_cast<double>(uniform);
    std::printf("%4d  %10zu  %12zu  %12zu  %5.3f\n", ++axis, fixed, uniform, chosen, ratio);
    ASSERT_GT(uniform, 0u);
    EXPECT_LE(ratio, 0.4);
  }
}

INSTANTIATE_TEST_SUITE_P(VelocityUnits, RecordCount, ::testing::Values(1.0, 0.001));

}  // namespace
}  // namespace interpolated_motion::encoding
