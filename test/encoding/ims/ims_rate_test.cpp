#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/ims/ims_executor.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"

// A rate that leads into a dead end is given up for the former one, from which the way on is known.
namespace interpolated_motion::encoding {
namespace {

using testing::goal_paths;
using testing::ims_encoding;
using testing::TextbookDrive;

constexpr double kTick = 120e-6;  ///< s

/// Segments of 12 ms and more that keep to one count: little room for another rate.
ImsEncoding narrow_encoding() {
  ImsEncoding encoding = ims_encoding();
  encoding.min_segment_ticks = 100;
  encoding.bound_counts = 1.0;
  return encoding;
}

/// A drive that executes the segments as they come, and true time along the path at the rate of each.
class Follower {
 public:
  Follower(const trajectory::Path& path, const ImsEncoding& encoding, std::int32_t start)
      : path_(path),
        encoding_(encoding),
        drive_(start, encoding.transmission.counts_per_revolution, testing::Order::HalfWay),
        time_(path.start_time()) {}

  void execute(const ImsSegment& segment, double rate) {
    drive_.begin(segment);
    for (std::int32_t i = 0; i < segment.time; ++i) {
      drive_.tick();
      time_ += GoalTime(kTick * rate);
      const double wanted = encoding_.transmission.counts(
          time_ < path_.end_time() ? path_.sample(time_).position : path_.final_position());
      worst_ = std::max(worst_, static_cast<double>(std::abs(drive_.position() - wanted)));
    }
  }
  double worst() const { return worst_; }  ///< counts
  double position() const { return static_cast<double>(drive_.position()); }
  double velocity() const { return static_cast<double>(drive_.velocity()); }

 private:
  const trajectory::Path& path_;
  const ImsEncoding& encoding_;
  TextbookDrive drive_;
  GoalTime time_;
  double worst_ = 0.0;
};

/// Asks for another rate at every knot; returns how often it was not taken.
int swing(const trajectory::Path& path, const ImsEncoding& encoding) {
  const std::int32_t start = testing::rounded_start(path, encoding);
  ImsEncoder encoder(path, encoding,
                     {0, path.start_time(), interpolation::ims_at_rest(encoding.law(), start)});
  Follower drive(path, encoding, start);
  int kept = 0;
  for (int i = 0; !encoder.finished(); ++i) {
    const double former = encoder.rate();
    const double asked = i % 2 == 0 ? 1.001 : 0.999;
    encoder.set_rate(asked);
    ImsSegment segment;
    ImsCertificate certificate;
    const auto more = encoder.next(segment, certificate);
    if (!more) {
      ADD_FAILURE() << more.error().text;
      return kept;
    }
    if (encoder.rate() != asked) {
      ++kept;
      EXPECT_EQ(encoder.rate(), former) << "segment " << i;
    }
    drive.execute(segment, encoder.rate());
  }
  EXPECT_LE(drive.worst(), encoding.bound_counts + 1e-3);
  EXPECT_EQ(drive.position(), std::round(encoding.transmission.counts(path.final_position())));
  EXPECT_EQ(drive.velocity(), 0.0);
  return kept;
}

TEST(ImsRate, OneThatLeadsIntoADeadEndIsGivenUpForTheFormer) {
  const std::string file = std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_20ms_pva.yaml";
  int kept = 0;
  for (const trajectory::Path& path : goal_paths(file)) kept += swing(path, narrow_encoding());
  EXPECT_GE(kept, 5) << "the way was never too narrow";
}

// With room enough every rate is taken.
TEST(ImsRate, OneThatCanBeFollowedIsTaken) {
  const std::string file = std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_20ms_pva.yaml";
  ImsEncoding wide = ims_encoding();
  wide.bound_counts = 20.0;
  for (const trajectory::Path& path : goal_paths(file)) EXPECT_EQ(swing(path, wide), 0);
}

}  // namespace
}  // namespace interpolated_motion::encoding
