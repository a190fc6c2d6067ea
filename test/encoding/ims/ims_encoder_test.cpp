#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/ims/ims_executor.h"

namespace interpolated_motion::encoding {
namespace {

using testing::End;
using testing::execute_segments;
using testing::ims_encoding;
using testing::path_through;
using testing::rounded_start;

trajectory::Path move(double distance, double seconds) {
  return path_through({0, seconds}, {{0, 0, 0}, {distance, 0, 0}}, true);
}

void expect_refused(const trajectory::Path& path, const ImsEncoding& encoding, std::int32_t start,
                    const std::vector<std::string>& words) {
  const auto stream = encode_ims(path, encoding, start);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, GoalError::InvalidGoal);
  for (const std::string& word : words) {
    EXPECT_NE(stream.error().text.find(word), std::string::npos)
        << word << " is missing in: " << stream.error().text;
  }
}

void expect_executed(const trajectory::Path& path, const ImsEncoding& encoding, const ImsStream& stream) {
  const auto execution = execute_segments(stream.segments, stream.start_counts, path, encoding);
  EXPECT_LE(execution.worst_deviation, encoding.bound_counts + 1e-3);
  EXPECT_EQ(execution.end, std::round(encoding.transmission.counts(path.final_position())));
  EXPECT_EQ(execution.end_velocity, 0.0);
}

TEST(ImsEncoder, PathWithoutPiecesIsOneSegmentAtRest) {
  const auto stream = encode_ims(trajectory::Path(0.1), ims_encoding(), 3183);  // 3183.0989 counts
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_EQ(stream.value().segments, (std::vector<ImsSegment>{{25, 3183, 0, 0}}));
  EXPECT_EQ(stream.value().terminator, (ImsSegment{0, 3183, 0, 0}));
  EXPECT_EQ(stream.value().duration, ServoTicks(25));
  EXPECT_NEAR(stream.value().worst_deviation_counts(), 0.0988618, 1e-6);
}

TEST(ImsEncoder, PathWithoutPiecesSettlesOnItsCount) {
  const trajectory::Path path(0.1);
  for (const std::int32_t start : {3182, 3184, 3185}) {
    const auto stream = encode_ims(path, ims_encoding(), start);
    ASSERT_TRUE(stream) << stream.error().text;
    EXPECT_EQ(stream.value().segments.size(), 1u);
    expect_executed(path, ims_encoding(), stream.value());
  }
}

TEST(ImsEncoder, RestTakesTheLongestSegments) {
  ImsEncoding encoding = ims_encoding();
  encoding.max_segment_ticks = 10000;
  const auto path = path_through({0, 6}, {{1, 0, 0}, {1, 0, 0}}, false);
  const auto stream = encode_ims(path, encoding, 31831);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_EQ(stream.value().segments, std::vector<ImsSegment>(5, {10000, 31831, 0, 0}));
}

TEST(ImsEncoder, MotionSmallerThanTheBoundEndsOnTheCount) {
  const auto path = move(0.9 / 31830.98, 2.0);
  const auto stream = encode_ims(path, ims_encoding(), 0);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_LE(stream.value().segments.size(), 6u);
  expect_executed(path, ims_encoding(), stream.value());
}

constexpr double kLongest = 0.25;  ///< s, of a segment

/// How long after the end of a path of rest (0.3 s, at 3183.0989 counts) a drive is at rest that is next to
/// it at `begin` s and moves at `counts_per_second`.
double rest_after_end(std::int32_t at, double counts_per_second, double begin) {
  constexpr double kEnd = 0.3;  // s
  const auto path = path_through({0, kEnd}, {{0.1, 0, 0}, {0.1, 0, 0}}, false);
  ImsEncoding encoding = ims_encoding();
  const double tick = encoding.scale.tick;
  encoding.max_segment_ticks = std::llround(kLongest / tick);
  ImsKnot knot{std::llround(begin / tick), GoalTime(begin), interpolation::ims_at_rest(encoding.law(), at)};
  knot.state.velocity = std::llround(counts_per_second * tick / encoding.law().counts_per_unit());
  ImsEncoder encoder(path, encoding, knot);
  ImsSegment segment;
  ImsCertificate certificate;
  for (int segments = 0; !encoder.finished() && segments < 10; ++segments) {
    if (const auto more = encoder.next(segment, certificate); !more) {
      ADD_FAILURE() << more.error().text;
      break;
    }
    EXPECT_LE(certificate.worst_deviation_counts, encoding.bound_counts);
  }
  EXPECT_TRUE(encoder.finished());
  return static_cast<double>(encoder.knot().tick) * tick - kEnd;
}

// Where a joint is slow to come to its last count, a drive may be left with less than a count a second, away
// from there or on its way. It is within the bound for long, but the path is over.
TEST(ImsEncoder, ADriveThatCreepsIsAtRestSoonAfterThePathsEnd) {
  constexpr double kSoon = kLongest + 0.05;  // s: a segment in which it lands, or brakes and settles
  for (const std::int32_t at : {3182, 3184}) {
    for (const double counts_per_second : {0.05, 0.3, 1.0, 4.0, 8.0}) {
      for (const double begin : {0.0, 0.25, 0.288, 0.3}) {
        SCOPED_TRACE(::testing::Message() << counts_per_second << " counts/s from " << at << " at " << begin);
        EXPECT_LE(rest_after_end(at, counts_per_second, begin), kSoon);
        EXPECT_LE(rest_after_end(at, -counts_per_second, begin), kSoon);
      }
    }
  }
}

TEST(ImsEncoder, LastSegmentRepeatsTheVelocityItStartsWith) {
  const ImsStream stream = encode_ims(move(1.2, 1.5), ims_encoding(), 0).value();
  const ImsSegment& last = stream.segments.back();
  EXPECT_EQ(last.position, 38197);  // 1.2 * 31830.9886
  EXPECT_EQ(last.velocity, stream.segments[stream.segments.size() - 2].velocity);
  EXPECT_GT(last.velocity, 0);
  EXPECT_GT(last.acceleration, 0);
}

TEST(ImsEncoder, CruiseIsHeld) {
  // Half a second of constant velocity between two cubics.
  const auto path =
      path_through({0, 0.5, 1.5, 2}, {{0, 0, 0}, {0.25, 1, 0}, {1.25, 1, 0}, {1.5, 0, 0}}, false);
  const ImsStream stream = encode_ims(path, ims_encoding(), 0).value();
  expect_executed(path, ims_encoding(), stream);
  // 4000 counts of motion in the second of cruise deviate by nothing, so it takes few segments.
  EXPECT_LE(stream.segments.size(), 16u);
}

TEST(ImsEncoder, ReversalsAreSplitAtZeroSpeed) {
  const auto path = path_through({0, 1, 2, 3}, {{0, 0, 0}, {0.5, 0, -3}, {-0.4, 0, 2}, {0.2, 0, 0}}, true);
  const ImsStream stream = encode_ims(path, ims_encoding(), 0).value();
  expect_executed(path, ims_encoding(), stream);
  int reversals = 0;
  for (std::size_t i = 1; i + 1 < stream.segments.size(); ++i) {
    const bool forwards = stream.segments[i].position > 0;
    if ((stream.segments[i + 1].position > 0) == forwards || i + 2 == stream.segments.size()) continue;
    EXPECT_EQ(stream.segments[i].velocity, 0);
    ++reversals;
  }
  EXPECT_EQ(reversals, 2);
}

TEST(ImsEncoder, CertificatesAreWhatTheDriveDoes) {
  const auto path = move(1.2, 1.5);
  const ImsEncoding encoding = ims_encoding();
  const ImsStream stream = encode_ims(path, encoding, 0).value();
  const auto execution = execute_segments(stream.segments, 0, path, encoding);
  ASSERT_EQ(stream.certificates.size(), stream.segments.size());
  double rpm = 0;
  double acceleration = 0;
  for (std::size_t i = 0; i < stream.segments.size(); ++i) {
    // The last segment's landing is the textbook's own there, and differs by a tick of slow motion.
    const double tolerance = i + 1 < stream.segments.size() ? 1e-6 : 0.05;
    EXPECT_NEAR(stream.certificates[i].worst_deviation_counts, execution.worst_of_segment[i], tolerance);
    rpm = std::max(rpm, stream.certificates[i].peak_rpm);
    acceleration = std::max(acceleration, stream.certificates[i].peak_acceleration);
  }
  EXPECT_NEAR(rpm, execution.peak_rpm, 1e-6 * rpm);
  EXPECT_NEAR(acceleration, execution.peak_acceleration, 1e-6 * acceleration);
}

TEST(ImsEncoder, ContinuesFromAnyKnot) {
  const auto path = move(2.0, 3.0);
  const ImsEncoding encoding = ims_encoding();
  const ImsKnot start{0, GoalTime(0), interpolation::ims_at_rest(encoding.law(), 0)};
  ImsEncoder encoder(path, encoding, start);
  std::vector<ImsSegment> segments;
  ImsSegment segment;
  ImsCertificate certificate;
  for (int i = 0; i < 7; ++i) {
    ASSERT_TRUE(encoder.next(segment, certificate).value());
    segments.push_back(segment);
  }
  ImsEncoder again(path, encoding, encoder.knot());
  while (!again.finished()) {
    ASSERT_TRUE(again.next(segment, certificate).value());
    segments.push_back(segment);
  }
  const auto execution = execute_segments(segments, 0, path, encoding);
  EXPECT_LE(execution.worst_deviation, 2.0 + 1e-3);
  EXPECT_EQ(execution.end, 63662.0);  // 2 * 31830.9886 = 63661.98
  EXPECT_FALSE(again.next(segment, certificate).value());
}

TEST(ImsEncoder, AnHourStaysWithinTheBound) {
  std::vector<double> times;
  std::vector<End> ends;
  for (int i = 0; i <= 3600; ++i) {
    times.push_back(i);
    ends.push_back({std::sin(0.7 * i), 0.7 * std::cos(0.7 * i), -0.49 * std::sin(0.7 * i)});
  }
  ends.front().v = ends.front().a = 0;
  ends.back().v = ends.back().a = 0;
  const auto path = path_through(times, ends, true);
  const auto stream = encode_ims(path, ims_encoding(), 0);
  ASSERT_TRUE(stream) << stream.error().text;
  expect_executed(path, ims_encoding(), stream.value());
}

TEST(ImsEncoder, ARateCompensatesTheDrivesCrystal) {
  const auto path = move(2.0, 3.0);
  const ImsEncoding encoding = ims_encoding();
  const ImsKnot start{0, GoalTime(0), interpolation::ims_at_rest(encoding.law(), 0)};
  for (const double rate : {0.999, 1.002}) {
    ImsEncoder encoder(path, encoding, start);
    encoder.set_rate(rate);
    std::vector<ImsSegment> segments;
    while (!encoder.finished()) {
      ImsSegment segment;
      ImsCertificate certificate;
      ASSERT_TRUE(encoder.next(segment, certificate).value());
      segments.push_back(segment);
    }
    const auto execution = execute_segments(segments, 0, path, encoding, testing::Order::HalfWay, rate);
    EXPECT_LE(execution.worst_deviation, 2.0 + 1e-3);
    EXPECT_NEAR(static_cast<double>(execution.ticks), 25000 / rate, 300);
    // Not compensated, 0.1 % of 1.25 rad/s after 1.5 s is 60 counts.
    EXPECT_GT(execute_segments(segments, 0, path, encoding).worst_deviation, 50);
  }
}

TEST(ImsEncoder, ARateMayChangeAtAnyKnot) {
  const auto path = move(2.0, 3.0);
  const ImsEncoding encoding = ims_encoding();
  ImsEncoder encoder(path, encoding, {0, GoalTime(0), interpolation::ims_at_rest(encoding.law(), 0)});
  ImsSegment segment;
  ImsCertificate certificate;
  double goal_time = 0;
  for (int i = 0; !encoder.finished(); ++i) {
    const double rate = i % 2 == 0 ? 1.0005 : 0.9995;
    encoder.set_rate(rate);
    ASSERT_TRUE(encoder.next(segment, certificate).value());
    goal_time += segment.time * 120e-6 * rate;
    EXPECT_NEAR(encoder.knot().goal_time.count(), goal_time, 1e-12);
    const GoalTime at = std::min(encoder.knot().goal_time, path.end_time());
    EXPECT_NEAR(interpolation::ims_counts(encoding.law(), encoder.knot().state),
                encoding.transmission.counts(path.sample(at).position), 2.0 + 1e-6);
    EXPECT_LE(certificate.worst_deviation_counts, 2.0);
  }
  EXPECT_THROW(encoder.set_rate(0.0), std::invalid_argument);
  EXPECT_THROW(encoder.set_rate(std::nan("")), std::invalid_argument);
}

TEST(ImsEncoder, PositionsWrapAroundInTheRegister) {
  ImsEncoding encoding = ims_encoding();
  encoding.transmission.offset = -67465.0;  // 2147477644.6 counts at 0, the register ends 6003 counts later
  for (const int direction : {1, -1}) {
    encoding.transmission.direction = direction;
    const auto path = move(1.0, 1.5);
    const auto stream = encode_ims(path, encoding, rounded_start(path, encoding));
    ASSERT_TRUE(stream) << stream.error().text;
    expect_executed(path, encoding, stream.value());
    EXPECT_LT(stream.value().segments.back().position * direction, 0);
  }
}

TEST(ImsEncoder, RefusesAStartOffThePath) {
  expect_refused(
      move(1, 1), ims_encoding(), 7,
      {"Joint 'elbow', at 0.000 s", "demand of 7.000 counts", "7.000 counts off", "bound is 2 counts"});
  EXPECT_TRUE(encode_ims(move(1, 2), ims_encoding(), 1));
  EXPECT_TRUE(encode_ims(move(1, 2), ims_encoding(), -1));
}

TEST(ImsEncoder, RefusesAPathOverTheFullScaleOfTheVelocity) {
  ImsEncoding encoding = ims_encoding();
  encoding.max_motor_rpm = std::numeric_limits<double>::infinity();
  // 1.875 * 10 / 2 = 9.375 rad/s at the middle: 4476 rpm of the motor.
  expect_refused(move(10, 2), encoding, 0, {"'elbow'", "the path needs", "limit of 4000.0 rpm"});
  EXPECT_TRUE(encode_ims(move(8, 2), encoding, 0));  // 3581 rpm
}

TEST(ImsEncoder, RefusesAPathOverTheMotorsVelocity) {
  ImsEncoding encoding = ims_encoding();
  encoding.max_motor_rpm = 1500;
  expect_refused(move(2, 1), encoding, 0, {"'elbow'", "the path needs", "limit of 1500.0 rpm"});  // 1790 rpm
}

TEST(ImsEncoder, RefusesAPathOverTheMotorsAcceleration) {
  ImsEncoding encoding = ims_encoding();
  encoding.max_motor_acceleration = 5000;
  // 5.7735 * 2 / 1 = 11.55 rad/s^2: 5513 rpm/s of the motor.
  expect_refused(move(2, 1), encoding, 0, {"'elbow'", "the path needs", "limit of 5000 rpm/s"});
  encoding.max_motor_acceleration = 6500;
  const auto stream = encode_ims(move(2, 1), encoding, 0);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_LE(execute_segments(stream.value().segments, 0, move(2, 1), encoding).peak_acceleration,
            6500 * (1 + 1e-6));
}

TEST(ImsEncoder, RefusesAStepInVelocity) {
  const auto path = path_through({0, 1}, {{0, 2, 0}, {2, 2, 0}}, false);
  expect_refused(path, ims_encoding(), 0, {"'elbow', at 0.000 s", "within 2 counts"});
}

TEST(ImsEncoder, RefusesNumbersThatAreNone) {
  const auto path = path_through({0, 1}, {{0, 0, 0}, {std::nan(""), 0, 0}}, false);
  expect_refused(path, ims_encoding(), 0, {"'elbow'", "position"});
}

TEST(ImsEncoding, ValidationNamesJointParameterValueAndRange) {
  const auto message_of = [](const ImsEncoding& encoding) -> std::string {
    try {
      encoding.validate();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(ims_encoding()), "");
  ImsEncoding encoding = ims_encoding();
  encoding.min_segment_ticks = 9000;
  EXPECT_EQ(message_of(encoding),
            "Joint 'elbow': min_segment_ticks is 9000, allowed is 1 to max_segment_ticks, 8192.");
  encoding = ims_encoding();
  encoding.max_segment_ticks = 65537;
  EXPECT_EQ(message_of(encoding), "Joint 'elbow': max_segment_ticks is 65537, allowed is 1 to 65536.");
  encoding = ims_encoding();
  encoding.scale.acceleration_full_scale_rpm_per_tick = 1234;
  EXPECT_NE(message_of(encoding).find("Joint 'elbow': IMS scale: acceleration_full_scale"),
            std::string::npos);
  for (double ImsEncoding::*parameter :
       {&ImsEncoding::bound_counts, &ImsEncoding::max_motor_rpm, &ImsEncoding::max_motor_acceleration}) {
    for (const double value : {0.0, std::nan("")}) {
      encoding = ims_encoding();
      encoding.*parameter = value;
      EXPECT_THROW(encoding.validate(), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::encoding
