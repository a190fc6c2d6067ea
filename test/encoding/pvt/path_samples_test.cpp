#include "interpolated_motion_driver/encoding/pvt/path_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "encoding/goal_paths.h"

namespace interpolated_motion::encoding {
namespace {

const Transmission kTransmission{2000, 100, -1, 0.5};

trajectory::Path wavy_path() {
  return testing::path_through({0.25, 1.0, 1.0007, 7.3333, 12.0},
                               {{0, 0, 0}, {1, 0.5, 0}, {1.0003, 0.4, 0}, {-2, -1, 0}, {0.5, 0, 0}}, false);
}

TEST(PathSamples, AgreeWithThePathAtEveryMillisecond) {
  const auto path = wavy_path();
  PathSamples samples(path, kTransmission);
  samples.move_window(0, samples.end());
  for (std::int64_t k = 0; k <= samples.end(); ++k) {
    const GoalTime time = std::min<GoalTime>(path.start_time() + DriveMilliseconds(k), path.end_time());
    const auto state = path.sample(time);
    ASSERT_NEAR(samples.position(k), kTransmission.counts(state.position), 1e-6) << k;
    ASSERT_NEAR(samples.velocity(k), kTransmission.counts_per_second(state.velocity) / 1000, 1e-8) << k;
  }
}

TEST(PathSamples, WindowThatMovesReadsTheSameAsAWholeOne) {
  const auto path = wavy_path();
  PathSamples whole(path, kTransmission);
  whole.move_window(0, whole.end());
  PathSamples moving(path, kTransmission);
  for (std::int64_t k = 0; k <= moving.end(); k += 37) {
    const auto last = std::min(moving.end(), k + 500);
    moving.move_window(k, last);
    ASSERT_EQ(moving.position(k), whole.position(k));
    ASSERT_EQ(moving.position(last), whole.position(last));
    ASSERT_EQ(moving.velocity(last), whole.velocity(last));
  }
}

TEST(PathSamples, StartInTheMiddle) {
  const auto path = wavy_path();
  PathSamples whole(path, kTransmission);
  whole.move_window(0, whole.end());
  PathSamples late(path, kTransmission, 9000);
  late.move_window(9000, 9100);
  EXPECT_EQ(late.position(9050), whole.position(9050));
}

TEST(PathSamples, EndIsTheFirstMillisecondAfterThePath) {
  const auto ends_at = [](double seconds) {
    const auto path = testing::path_through({0, seconds}, {{0, 0, 0}, {1, 0, 0}}, false);
    return PathSamples(path, kTransmission).end();
  };
  EXPECT_EQ(ends_at(6.718061196), 6719);
  EXPECT_EQ(ends_at(0.3), 300);
  EXPECT_EQ(ends_at(0.1 + 0.2), 300);
  EXPECT_EQ(ends_at(0.0004), 1);
  EXPECT_EQ(PathSamples(trajectory::Path(1.0), kTransmission).end(), 1);
}

}  // namespace
}  // namespace interpolated_motion::encoding
