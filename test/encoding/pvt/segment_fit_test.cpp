#include "interpolated_motion_driver/encoding/pvt/segment_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoding/goal_paths.h"

namespace interpolated_motion::encoding {
namespace {

const Transmission kTransmission{2000, 100, 1, 0.0};

/// 0.1 rpm at 2000 counts/rev in counts/ms; one count; 6000 rpm; 30000 rpm/s.
constexpr SegmentRules kRules{2e3 / 6e5, 1.0, 200.0, 1.0, 200.0};

class SegmentFitTest : public ::testing::Test {
 protected:
  SegmentFitTest() { samples_.move_window(0, samples_.end()); }

  double deviation(std::int64_t duration, std::int32_t position, double velocity) const {
    SegmentRules exact = kRules;  // a unit so fine that any velocity is a whole number of it
    exact.velocity_unit = 1e-7;
    return execute(
               samples_, exact, {},
               {duration, position, static_cast<std::int32_t>(std::lround(velocity / exact.velocity_unit))})
        .deviation;
  }

  trajectory::Path path_ = testing::path_through({0, 1}, {{0, 0, 0}, {1, 0, 0}}, true);
  PathSamples samples_{path_, kTransmission};
  SegmentFit fit_{samples_, kRules, kRules.bound, {}};
};

TEST_F(SegmentFitTest, IntervalHoldsTheVelocitiesThatKeepTheBound) {
  for (std::int64_t duration = 8; duration <= 40; ++duration) {
    const auto position = static_cast<std::int32_t>(std::lround(samples_.position(duration)));
    const auto interval = fit_.within_bound(duration, position);
    ASSERT_FALSE(interval.empty()) << duration;
    // The seven samples tested may miss the worst by a few per cent, never the other way round.
    EXPECT_LE(deviation(duration, position, interval.low), 1.06) << duration;
    EXPECT_LE(deviation(duration, position, interval.high), 1.06) << duration;
    const double margin = 0.02 * (interval.high - interval.low);
    EXPECT_GT(deviation(duration, position, interval.low - margin), 1.0) << duration;
    EXPECT_GT(deviation(duration, position, interval.high + margin), 1.0) << duration;
  }
}

TEST_F(SegmentFitTest, NoVelocityMakesUpForASegmentMuchTooLong) {
  const auto position = std::round(samples_.position(250));
  EXPECT_TRUE(fit_.within_bound(250, position).empty());
}

TEST_F(SegmentFitTest, LimitsCutToTheAccelerationsAtBothEnds) {
  // From rest over 5 counts in 10 ms: at the start 6 * 5 / 100 - 2 v / 10, at the end -6 * 5 / 100 + 4 v /
  // 10, each within +-1: v in [-3.5, 6.5] and in [-1.75, 3.25].
  const auto interval = fit_.within_limits({-100, 100}, 10, 5);
  EXPECT_NEAR(interval.low, -1.75, 1e-12);
  EXPECT_NEAR(interval.high, 3.25, 1e-12);
  EXPECT_TRUE(fit_.keeps_limits(10, 5, 3.2499));
  EXPECT_FALSE(fit_.keeps_limits(10, 5, 3.2501));
}

TEST_F(SegmentFitTest, LimitsCutToTheKnotVelocity) {
  const auto interval = fit_.within_limits({-1000, 1000}, 255, 255 * 150);
  EXPECT_LE(interval.high, 200.0);
}

}  // namespace
}  // namespace interpolated_motion::encoding
