#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "encoding/goal_paths.h"
#include "encoding/pvt/pvt_executor.h"

namespace interpolated_motion::encoding {
namespace {

using testing::End;
using testing::execute_records;
using testing::path_through;
using testing::rounded_start;
using testing::six_axis_encoding;

trajectory::Path move(double distance, double seconds) {
  return path_through({0, seconds}, {{0, 0, 0}, {distance, 0, 0}}, true);
}

void expect_refused(const trajectory::Path& path, const PvtEncoding& encoding, std::int32_t start,
                    const std::vector<std::string>& words) {
  const auto stream = encode_pvt(path, encoding, start);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, GoalError::InvalidGoal);
  for (const std::string& word : words) {
    EXPECT_NE(stream.error().text.find(word), std::string::npos)
        << word << " is missing in: " << stream.error().text;
  }
}

TEST(PvtEncoder, PathWithoutPiecesIsOneRecordAtRest) {
  const PvtEncoding encoding = six_axis_encoding(1);
  const trajectory::Path path(0.1);  // 3183.0989 counts
  const auto stream = encode_pvt(path, encoding, 3183);
  ASSERT_TRUE(stream);
  EXPECT_EQ(stream.value().records, (std::vector<PvtRecord>{{3183, 0, 1}}));
  EXPECT_EQ(stream.value().duration, DriveMilliseconds(1));
  EXPECT_NEAR(stream.value().worst_deviation_counts(), 0.0988618, 1e-6);
}

TEST(PvtEncoder, PathWithoutPiecesHasTimeToRoundWithinTheLimits) {
  // One count from rest to rest at 2000 counts/rev: 180000 rpm/s in 1 ms, 45000 in 2 ms, 20000 in 3 ms.
  const PvtEncoding encoding = six_axis_encoding(1);
  const auto stream = encode_pvt(trajectory::Path(0.1), encoding, 3184);
  ASSERT_TRUE(stream);
  EXPECT_EQ(stream.value().records, (std::vector<PvtRecord>{{3183, 0, 3}}));
}

TEST(PvtEncoder, PathShorterThanAMillisecondIsOneRecord) {
  const auto stream = encode_pvt(move(0.3 / 31830.98, 0.0005), six_axis_encoding(1), 0);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_EQ(stream.value().records, (std::vector<PvtRecord>{{0, 0, 1}}));
}

TEST(PvtEncoder, MotionSmallerThanTheBoundTakesLongRecords) {
  const auto stream = encode_pvt(move(0.9 / 31830.98, 2.0), six_axis_encoding(1), 0);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_LE(stream.value().records.size(), 9u);
  EXPECT_EQ(stream.value().records.back().position, 1);
  EXPECT_EQ(stream.value().duration, DriveMilliseconds(2000));
}

TEST(PvtEncoder, RestTakesTheLongestRecords) {
  const auto path = path_through({0, 10.2}, {{1, 0, 0}, {1, 0, 0}}, false);
  PvtEncoding encoding = six_axis_encoding(1);
  const auto stream = encode_pvt(path, encoding, 31831);
  ASSERT_TRUE(stream);
  EXPECT_EQ(stream.value().records, std::vector<PvtRecord>(40, {31831, 0, 255}));
  encoding.max_record_ms = 100;
  EXPECT_EQ(encode_pvt(path, encoding, 31831).value().records, std::vector<PvtRecord>(102, {31831, 0, 100}));
}

TEST(PvtEncoder, EndsAtRestOnTheRoundedEndAfterTheLastMillisecond) {
  const auto path = path_through({2.5, 3.1, 3.70037}, {{0, 0, 0}, {0.4, 1, 0}, {0.7, 0, 0}}, false);
  const auto stream = encode_pvt(path, six_axis_encoding(0.1), 0);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_EQ(stream.value().records.back().position, 22282);  // 0.7 * 31830.9886 = 22281.69
  EXPECT_EQ(stream.value().records.back().velocity, 0);
  EXPECT_EQ(stream.value().duration, DriveMilliseconds(1201));
}

TEST(PvtEncoder, CertificatesAreWhatTheDriveDoes) {
  const auto path = move(1.2, 1.5);
  const PvtEncoding encoding = six_axis_encoding(1);
  const PvtStream stream = encode_pvt(path, encoding, 0).value();
  const auto execution = execute_records(stream.records, {0, 0, 0}, path, encoding);
  ASSERT_EQ(stream.certificates.size(), stream.records.size());
  double rpm = 0;
  double acceleration = 0;
  for (std::size_t i = 0; i < stream.records.size(); ++i) {
    EXPECT_NEAR(stream.certificates[i].worst_deviation_counts, execution.worst_of_record[i], 1e-6);
    rpm = std::max(rpm, stream.certificates[i].peak_rpm);
    acceleration = std::max(acceleration, stream.certificates[i].peak_acceleration);
  }
  EXPECT_NEAR(rpm, execution.peak_rpm, 1e-3 * rpm);
  EXPECT_NEAR(acceleration, execution.peak_acceleration, 1e-6 * acceleration);
}

TEST(PvtEncoder, ContinuesFromAnyKnot) {
  const auto path = move(2.0, 3.0);
  const PvtEncoding encoding = six_axis_encoding(1);
  PvtEncoder encoder(path, encoding, {0, 0, 0});
  PvtRecord record;
  PvtCertificate certificate;
  for (int i = 0; i < 7; ++i) ASSERT_TRUE(encoder.next(record, certificate).value());
  const PvtKnot knot = encoder.knot();
  EXPECT_EQ(knot.position, record.position);
  EXPECT_EQ(knot.velocity, record.velocity);

  PvtEncoder again(path, encoding, knot);
  std::vector<PvtRecord> records;
  while (!again.finished()) {
    ASSERT_TRUE(again.next(record, certificate).value());
    records.push_back(record);
  }
  const auto execution = execute_records(records, knot, path, encoding);
  EXPECT_LE(execution.worst_deviation, 1.0 + 1e-6);
  EXPECT_EQ(execution.duration_ms, 3000);
  EXPECT_FALSE(again.next(record, certificate).value());
}

TEST(PvtEncoder, TenMinutesStayWithinTheBound) {
  std::vector<double> times;
  std::vector<End> ends;
  for (int i = 0; i <= 600; ++i) {
    times.push_back(0.1 * 10 * i);
    ends.push_back({std::sin(0.7 * i), 0.7 * std::cos(0.7 * i), -0.49 * std::sin(0.7 * i)});
  }
  ends.front().v = ends.front().a = 0;
  ends.back().v = ends.back().a = 0;
  const auto path = path_through(times, ends, true);
  const PvtEncoding encoding = six_axis_encoding(0.1);
  const PvtStream stream = encode_pvt(path, encoding, 0).value();
  const auto execution = execute_records(stream.records, {0, 0, 0}, path, encoding);
  EXPECT_LE(execution.worst_deviation, 1.0 + 1e-6);
  EXPECT_EQ(execution.duration_ms, 600000);
  EXPECT_EQ(stream.records.back().position, std::lround(encoding.transmission.counts(ends.back().p)));
}

TEST(PvtEncoder, RefusesAStartOffThePath) {
  expect_refused(
      move(1, 1), six_axis_encoding(1), 7,
      {"Joint 'elbow', at 0.000 s", "demand of 7 counts", "7.000 counts off", "bound is 1 counts"});
  EXPECT_TRUE(encode_pvt(move(1, 2), six_axis_encoding(1), 1));
  EXPECT_TRUE(encode_pvt(move(1, 2), six_axis_encoding(1), -1));
}

TEST(PvtEncoder, RefusesAPositionBeyond32Bits) {
  PvtEncoding encoding = six_axis_encoding(1);
  encoding.transmission.offset = -67463.0;  // 2147413985 counts at joint position 0
  const auto path = path_through({0, 2}, {{0, 0, 0}, {10, 0, 0}}, true);
  expect_refused(path, encoding, rounded_start(path, encoding),
                 {"'elbow'", "position 2147483", "-2147483648 .. 2147483647"});
  encoding.transmission.direction = -1;
  expect_refused(path, encoding, rounded_start(path, encoding), {"'elbow'", "position -2147483"});
}

TEST(PvtEncoder, RefusesAVelocityBeyond24Bits) {
  PvtEncoding encoding = six_axis_encoding(0.001);
  encoding.max_motor_rpm = 20000;
  encoding.max_motor_acceleration = std::numeric_limits<double>::infinity();
  // Rest to rest over 10 rad in 2 s peaks at 1.875 * 10 / 2 = 9.375 rad/s: 8952 rpm of the motor, 8388.607
  // fit.
  expect_refused(move(10, 2), encoding, 0,
                 {"'elbow', at 0.822 s", "velocity 8394.2 rpm", "+-8388607 units of 0.001 rpm"});
  encoding.velocity_unit_rpm = 0.01;
  EXPECT_TRUE(encode_pvt(move(10, 2), encoding, 0));
}

TEST(PvtEncoder, RefusesAPathOverTheDrivesVelocity) {
  PvtEncoding encoding = six_axis_encoding(1);
  encoding.max_motor_rpm = 3000;
  // 1.875 * 2 / 1 = 3.75 rad/s at the middle: 3581 rpm of the motor.
  expect_refused(move(2, 1), encoding, 0, {"'elbow'", "rpm", "limit of 3000.0 rpm (0x607F)"});
  encoding.max_motor_rpm = 3600;
  EXPECT_TRUE(encode_pvt(move(2, 1), encoding, 0));
}

TEST(PvtEncoder, RefusesAPathOverTheDrivesAcceleration) {
  PvtEncoding encoding = six_axis_encoding(1);
  encoding.max_motor_acceleration = 10000;
  // 5.7735 * 2 / 1 = 11.55 rad/s^2: 11027 rpm/s of the motor.
  expect_refused(move(2, 1), encoding, 0, {"'elbow'", "the path needs", "limit of 10000 rpm/s (0x60C5)"});
  encoding.max_motor_acceleration = 12000;
  EXPECT_TRUE(encode_pvt(move(2, 1), encoding, 0));
}

TEST(PvtEncoder, RefusesABoundThatCountsCannotMeet) {
  PvtEncoding encoding = six_axis_encoding(1);
  encoding.bound_counts = 0.2;
  const auto path = path_through({0, 2}, {{0, 0, 0}, {1.5 / 31830.98, 0, 0}}, true);
  expect_refused(path, encoding, 0, {"'elbow'", "within 0.2 counts", "raise the bound"});
}

TEST(PvtEncoder, RefusesAStepInVelocity) {
  const auto path = path_through({0, 1}, {{0, 2, 0}, {2, 2, 0}}, false);
  expect_refused(path, six_axis_encoding(1), 0, {"'elbow', at 0.000 s"});
}

TEST(PvtEncoder, RefusesNumbersThatAreNone) {
  const auto path = path_through({0, 1}, {{0, 0, 0}, {std::nan(""), 0, 0}}, false);
  expect_refused(path, six_axis_encoding(1), 0, {"'elbow'", "position"});
}

TEST(PvtEncoder, PrefersLongRecordsWhereRoundingWouldBreakTheLimit) {
  // 0.5 counts in 1 ms are up to 90000 rpm/s; the path itself needs 551 rpm/s.
  PvtEncoding encoding = six_axis_encoding(1);
  encoding.max_motor_acceleration = 800;
  const auto path = move(1, 3.1623);
  const auto stream = encode_pvt(path, encoding, 0);
  ASSERT_TRUE(stream) << stream.error().text;
  const auto execution = execute_records(stream.value().records, {0, 0, 0}, path, encoding);
  EXPECT_LE(execution.peak_acceleration, 800 * (1 + 1e-9));
  EXPECT_LE(execution.worst_deviation, 1 + 1e-6);
}

TEST(PvtEncoding, ValidationNamesJointParameterValueAndRange) {
  const auto message_of = [](const PvtEncoding& encoding) -> std::string {
    try {
      encoding.validate();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(six_axis_encoding(0.01)), "");
  PvtEncoding encoding = six_axis_encoding(0.5);
  EXPECT_EQ(message_of(encoding),
            "Joint 'elbow': velocity_unit_rpm is 0.5, allowed is 1, 0.1, 0.01 or 0.001.");
  encoding = six_axis_encoding(1);
  encoding.max_record_ms = 256;
  EXPECT_EQ(message_of(encoding), "Joint 'elbow': max_record_ms is 256, allowed is 1 to 255.");
  encoding = six_axis_encoding(1);
  encoding.transmission.direction = 0;
  EXPECT_EQ(message_of(encoding), "Joint 'elbow': direction is 0, allowed is 1 or -1.");
  for (double PvtEncoding::*parameter :
       {&PvtEncoding::bound_counts, &PvtEncoding::max_motor_rpm, &PvtEncoding::max_motor_acceleration,
        &PvtEncoding::velocity_unit_rpm}) {
    encoding = six_axis_encoding(1);
    encoding.*parameter = 0.0;
    EXPECT_THROW(PvtEncoder(trajectory::Path(0.0), encoding, {0, 0, 0}), std::invalid_argument);
    encoding.*parameter = std::nan("");
    EXPECT_THROW(encoding.validate(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace interpolated_motion::encoding
