#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/ims/ims_executor.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "trajectory/random.h"

namespace interpolated_motion::encoding {
namespace {

using testing::End;
using trajectory::property_cases;
using trajectory::Random;

constexpr double kMaxAcceleration = 6.0;  // rad/s^2, between the points

/// Moves with reversals and rests, quintic or cubic.
class RandomMoves {
 public:
  explicit RandomMoves(Random& random) : random_(random), quintic_(random.integer(0, 1) == 0) {
    times_.push_back(random.integer(0, 1) == 0 ? 0.0 : random.uniform(0, 3));
    ends_.push_back({random.uniform(-2, 2), 0, 0});
    const int moves = random.integer(1, 10);
    for (int i = 0; i < moves; ++i) {
      random.integer(0, 4) == 0 ? rest() : advance(random.uniform(0.05, 1.2), random.uniform(-1, 1));
    }
    stop();
  }

  trajectory::Path path() const { return testing::path_through(times_, ends_, quintic_); }

 private:
  /// A piece of `h` s whose mean acceleration is `part` of the greatest.
  void advance(double h, double part) {
    const End from = ends_.back();
    End to;
    to.v = std::clamp(from.v + part * kMaxAcceleration * h, -2.0, 2.0);
    to.a = quintic_ ? (to.v - from.v) / h * random_.uniform(0.5, 1.5) : 0.0;
    to.p = from.p + h * (from.v + to.v) / 2 +
           (quintic_ ? h * h * (from.a - to.a) / 12 : h * h * random_.uniform(-0.2, 0.2));
    append(h, to);
  }
  void stop() {
    const End from = ends_.back();
    const double h = std::max(0.15, std::abs(from.v) / (0.7 * kMaxAcceleration));
    append(h, {from.p + h * from.v / 2 + (quintic_ ? h * h * from.a / 12 : 0.0), 0, 0});
  }
  void rest() {
    stop();
    append(random_.uniform(0.01, 2.0), End(ends_.back()));
  }
  void append(double h, const End& to) {
    times_.push_back(times_.back() + h);
    ends_.push_back(to);
  }

  Random& random_;
  bool quintic_;
  std::vector<double> times_;
  std::vector<End> ends_;
};

ImsEncoding random_encoding(Random& random) {
  constexpr double kResolutions[] = {4000, 8000, 16000, 2048};
  constexpr double kRatios[] = {1, 33.4, 50, 100};
  constexpr double kBounds[] = {1, 2, 2, 5};
  constexpr double kOrders[] = {0.0, 0.5, 1.0};
  ImsEncoding encoding;
  encoding.joint = "wrist";
  encoding.transmission.counts_per_revolution = kResolutions[random.integer(0, 3)];
  encoding.transmission.ratio = kRatios[random.integer(0, 3)];
  encoding.transmission.direction = random.integer(0, 1) == 0 ? 1 : -1;
  encoding.transmission.offset = random.uniform(-3, 3);
  encoding.bound_counts = kBounds[random.integer(0, 3)];
  encoding.scale.position_lag = kOrders[random.integer(0, 2)];
  encoding.max_segment_ticks = random.integer(0, 3) == 0 ? 1000 : 8192;
  encoding.min_segment_ticks = random.integer(0, 1) == 0 ? 1 : 25;
  encoding.max_motor_rpm = 4000;
  encoding.max_motor_acceleration = 1e5;
  return encoding;
}

testing::Order order_of(const ImsEncoding& encoding) {
  if (encoding.scale.position_lag == 0.0) return testing::Order::VelocityFirst;
  return encoding.scale.position_lag == 1.0 ? testing::Order::PositionFirst : testing::Order::HalfWay;
}

TEST(ImsProperty, RandomPathsAreExecutedWithinBoundAndLimits) {
  Random random(20240607);
  const int cases = property_cases(300);
  for (int n = 0; n < cases; ++n) {
    const trajectory::Path path = RandomMoves(random).path();
    const ImsEncoding encoding = random_encoding(random);
    const std::int32_t start = testing::rounded_start(path, encoding);
    const auto result = encode_ims(path, encoding, start);
    ASSERT_TRUE(result) << "case " << n << ": " << result.error().text;
    const ImsStream& stream = result.value();
    const auto execution =
        testing::execute_segments(stream.segments, start, path, encoding, order_of(encoding));
    for (std::size_t i = 0; i < stream.segments.size(); ++i) {
      // Where to begin braking is the drive's own decision, and may differ by a tick of slow motion.
      const bool projected = std::abs(std::int64_t{stream.segments[i].position} - start) > (1 << 29);
      const double tolerance = projected || stream.segments[i].acceleration == 0 ? 1e-3 : 0.1;
      ASSERT_LE(execution.worst_of_segment[i], encoding.bound_counts + tolerance) << "case " << n;
    }
    ASSERT_LE(execution.peak_rpm, encoding.max_motor_rpm * (1 + 1e-9)) << "case " << n;
    ASSERT_LE(execution.peak_acceleration, encoding.max_motor_acceleration * (1 + 1e-6)) << "case " << n;
    ASSERT_EQ(execution.end, std::round(encoding.transmission.counts(path.final_position()))) << "case " << n;
    ASSERT_EQ(execution.end_velocity, 0.0) << "case " << n;
    // The textbook drive decides anew each tick whether to brake, without looking at the speed it gains: it
    // may be late by the change of a tick and its own half, two at the greatest acceleration.
    const double step =
        encoding.max_motor_acceleration / 60 * encoding.transmission.counts_per_revolution * 120e-6 * 120e-6;
    ASSERT_LE(execution.snap, 0.05 + 2 * step) << "case " << n;
    const double seconds = (path.end_time() - path.start_time()).count();
    ASSERT_GE(static_cast<double>(execution.ticks), std::floor(seconds / 120e-6)) << "case " << n;
    for (const ImsSegment& segment : stream.segments) {
      ASSERT_GE(segment.time, encoding.min_segment_ticks) << "case " << n;
      ASSERT_LE(segment.time, encoding.max_segment_ticks) << "case " << n;
      ASSERT_GE(segment.acceleration, 0) << "case " << n;
      ASSERT_LE(segment.acceleration, 1 << 30) << "case " << n;
      ASSERT_EQ(segment.acceleration % 2, 0) << "case " << n;
      ASSERT_GE(segment.velocity, 0) << "case " << n;
    }
  }
}

TEST(ImsProperty, EncodingIsDeterministic) {
  Random random(99);
  for (int n = 0; n < 10; ++n) {
    const trajectory::Path path = RandomMoves(random).path();
    const ImsEncoding encoding = random_encoding(random);
    const std::int32_t start = testing::rounded_start(path, encoding);
    EXPECT_EQ(encode_ims(path, encoding, start).value().segments,
              encode_ims(path, encoding, start).value().segments);
  }
}

}  // namespace
}  // namespace interpolated_motion::encoding
