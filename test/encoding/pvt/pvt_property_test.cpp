#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/pvt/pvt_executor.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"

namespace interpolated_motion::encoding {
namespace {

using testing::End;

int property_cases() {
  const char* text = std::getenv("IMD_PROPERTY_CASES");
  return text != nullptr ? std::atoi(text) : 300;
}

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  template <class Value>
  Value one_of(std::initializer_list<Value> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }

 private:
  std::mt19937_64 engine_;
};

constexpr double kMaxAcceleration = 6.0;  // rad/s^2, between the points

/// From tiny spacing to long moves, with reversals and rests.
class RandomPath {
 public:
  explicit RandomPath(Dice& dice) : dice_(dice), quintic_(dice.below(2) == 0) {
    times_.push_back(dice.below(2) == 0 ? 0.0 : dice.between(0, 3));
    ends_.push_back({dice.between(-2, 2), 0, 0});
    const int moves = 1 + dice.below(10);
    for (int i = 0; i < moves; ++i) dice.below(5) == 0 ? rest() : advance(spacing(), dice.between(-1, 1));
    stop();
  }

  trajectory::Path path() const { return testing::path_through(times_, ends_, quintic_); }

 private:
  double spacing() {
    switch (dice_.below(3)) {
      case 0:
        return dice_.between(0.0002, 0.006);
      case 1:
        return dice_.between(0.02, 0.3);
      default:
        return dice_.between(0.3, 1.2);
    }
  }
  /// A piece of `h` s whose mean acceleration is `part` of the greatest.
  void advance(double h, double part) {
    const End& from = ends_.back();
    End to;
    to.v = std::clamp(from.v + part * kMaxAcceleration * h, -3.0, 3.0);
    to.a = quintic_ ? (to.v - from.v) / h * dice_.between(0.5, 1.5) : 0.0;
    to.p = from.p + h * (from.v + to.v) / 2 +
           (quintic_ ? h * h * (from.a - to.a) / 12 : h * h * dice_.between(-0.2, 0.2));
    append(h, to);
  }
  void stop() {
    const End& from = ends_.back();
    const double h = std::max(0.15, std::abs(from.v) / (0.7 * kMaxAcceleration));
    append(h, {from.p + h * from.v / 2 + (quintic_ ? h * h * from.a / 12 : 0.0), 0, 0});
  }
  void rest() {
    stop();
    append(dice_.between(0.01, 1.0), ends_.back());
  }
  void append(double h, const End& to) {
    const End copy = to;
    times_.push_back(times_.back() + h);
    ends_.push_back(copy);
  }

  Dice& dice_;
  bool quintic_;
  std::vector<double> times_;
  std::vector<End> ends_;
};

PvtEncoding random_encoding(Dice& dice) {
  PvtEncoding encoding;
  encoding.joint = "wrist";
  encoding.transmission.counts_per_revolution = dice.one_of({500.0, 2000.0, 4096.0, 65536.0});
  encoding.transmission.ratio = dice.one_of({1.0, 33.4, 100.0, 160.0});
  encoding.transmission.direction = dice.one_of({1, -1});
  encoding.transmission.offset = dice.between(-3, 3);
  encoding.velocity_unit_rpm = dice.one_of({1.0, 0.1, 0.01, 0.001});
  encoding.bound_counts = dice.one_of({0.7, 1.0, 1.0, 2.0, 5.0});
  encoding.max_record_ms = dice.one_of<std::int64_t>({255, 255, 100, 20});
  return encoding;
}

/// Limits of the drive somewhat above what the path needs and what rounding over a few ms adds: 1 count, 1
/// unit.
void set_limits(PvtEncoding& encoding, const trajectory::Path& path) {
  double rpm = 0;
  double acceleration = 0;
  for (GoalTime t = path.start_time(); t < path.end_time(); t += GoalTime(0.0005)) {
    const auto state = path.sample(t);
    rpm = std::max(rpm, std::abs(encoding.transmission.motor_rpm(state.velocity)));
    acceleration = std::max(acceleration, std::abs(encoding.transmission.motor_rpm(state.acceleration)));
  }
  const double count_in_5_ms = 6 / 25.0 * 6e7 / encoding.transmission.counts_per_revolution;     // rpm/s
  const double count_in_10_ms = 1.5 / 10.0 * 6e4 / encoding.transmission.counts_per_revolution;  // rpm
  encoding.max_motor_rpm = 1.05 * rpm + count_in_10_ms + 2 * encoding.velocity_unit_rpm;
  encoding.max_motor_acceleration = 1.25 * acceleration + count_in_5_ms + 1000 * encoding.velocity_unit_rpm;
}

TEST(PvtProperty, RandomPathsAreExecutedWithinBoundAndLimits) {
  Dice dice(20240607);
  for (int n = 0; n < property_cases(); ++n) {
    const trajectory::Path path = RandomPath(dice).path();
    PvtEncoding encoding = random_encoding(dice);
    set_limits(encoding, path);
    const std::int32_t start = testing::rounded_start(path, encoding);
    const auto result = encode_pvt(path, encoding, start);
    ASSERT_TRUE(result) << "case " << n << ": " << result.error().text;
    const PvtStream& stream = result.value();
    const auto execution = testing::execute_records(stream.records, {0, start, 0}, path, encoding);
    const double duration = std::ceil((path.end_time() - path.start_time()).count() * 1000 - 1e-6);
    ASSERT_LE(execution.worst_deviation, encoding.bound_counts + 1e-5) << "case " << n;
    ASSERT_LE(execution.peak_rpm, encoding.max_motor_rpm * (1 + 1e-9)) << "case " << n;
    ASSERT_LE(execution.peak_acceleration, encoding.max_motor_acceleration * (1 + 1e-9)) << "case " << n;
    ASSERT_EQ(static_cast<double>(execution.duration_ms), duration) << "case " << n;
    ASSERT_EQ(stream.records.back().velocity, 0) << "case " << n;
    ASSERT_EQ(stream.records.back().position,
              std::lround(encoding.transmission.counts(path.final_position())));
    for (const PvtRecord& record : stream.records) {
      ASSERT_GE(record.time, 1);
      ASSERT_LE(record.time, encoding.max_record_ms);
    }
  }
}

TEST(PvtProperty, EncodingIsDeterministic) {
  Dice dice(99);
  for (int n = 0; n < 10; ++n) {
    const trajectory::Path path = RandomPath(dice).path();
    PvtEncoding encoding = random_encoding(dice);
    set_limits(encoding, path);
    const std::int32_t start = testing::rounded_start(path, encoding);
    EXPECT_EQ(encode_pvt(path, encoding, start).value().records,
              encode_pvt(path, encoding, start).value().records);
  }
}

}  // namespace
}  // namespace interpolated_motion::encoding
