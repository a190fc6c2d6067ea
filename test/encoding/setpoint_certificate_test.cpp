#include "interpolated_motion_driver/encoding/setpoint_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "encoding/goal_paths.h"
#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"
#include "interpolated_motion_driver/trajectory/stop_path.h"

namespace interpolated_motion::encoding {
namespace {

constexpr double kPi = 3.14159265358979324;

SetpointEncoding encoding(double counts_per_radian, double period = 0.010) {
  SetpointEncoding e;
  e.joint = "elbow";
  e.transmission.counts_per_revolution = counts_per_radian * 2.0 * kPi;
  e.period = GoalTime{period};
  e.bound_counts = 1e9;
  return e;
}

trajectory::Path piece(double duration, const trajectory::Polynomial& polynomial) {
  return trajectory::Path({{GoalTime{0.0}, GoalTime{duration}, polynomial}});
}

/// Lagrange's form of the polynomial through the last order + 1 setpoints: the drive's demand, another way.
double lagrange(const std::vector<double>& times, const std::vector<double>& values, double t) {
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < times.size(); ++j)
      if (j != i) weight *= (t - times[j]) / (times[i] - times[j]);
    sum += weight * values[i];
  }
  return sum;
}

/// Worst deviation with the setpoints at `phase` + k `period`, samples each ms.
double executed(const trajectory::Path& path, const SetpointEncoding& e, double phase) {
  const double period = e.period.count();
  const auto counts = [&](double t) { return e.transmission.counts(path.sample(GoalTime{t}).position); };
  double worst = 0.0;
  for (double t0 = phase - period; t0 < path.end_time().count() + 4 * period; t0 += period) {
    std::vector<double> times;
    std::vector<double> values;
    for (int i = 0; i <= e.order; ++i) {
      times.push_back(t0 + period * (1 - i));
      values.push_back(std::round(counts(times.back())));
    }
    const int samples = static_cast<int>(std::lround(period / e.servo_period.count()));
    for (int k = 0; k < samples; ++k) {
      const double t = t0 + k * e.servo_period.count();
      worst = std::max(worst, std::abs(lagrange(times, values, t) - counts(t)));
    }
  }
  return worst;
}

TEST(SetpointCertificate, IsWhatTheDriveWillDoByAnotherReckoning) {
  const auto paths =
      testing::goal_paths(std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_100ms_pva.yaml");
  for (int order = 1; order <= 3; ++order) {
    auto e = encoding(31830.0);
    e.order = order;
    double expected = 0.0;
    for (int phase = 0; phase < 4; ++phase)
      expected = std::max(expected, executed(paths[1], e, phase * 0.0025));
    // Instants reckoned in two ways differ in their last digits, and so may a rounding of a half.
    EXPECT_NEAR(certify_setpoints(paths[1], e).value().worst_deviation, expected, 0.05) << "order " << order;
  }
}

TEST(SetpointCertificate, RoundingIsAllThatIsLeftOfAPathAtRest) {
  EXPECT_LE(certify_setpoints(trajectory::Path(0.123456), encoding(1000.0)).value().worst_deviation, 0.5);
}

// A kink in velocity of dv: the linear drive cuts it by up to dv T / 4.
TEST(SetpointCertificate, LinearDriveCutsAKinkByAQuarterOfThePeriod) {
  trajectory::Polynomial up;
  up.coefficients = {0.0, 1.0};
  auto e = encoding(1e6);
  e.order = 1;
  const trajectory::Polynomial down{{0.505, -1.0, 0, 0, 0, 0}};
  const trajectory::Path tent(
      {{GoalTime{0.0}, GoalTime{0.505}, up}, {GoalTime{0.505}, GoalTime{1.01}, down}});
  EXPECT_NEAR(certify_setpoints(tent, e).value().worst_deviation, 2.0 * 0.010 / 4.0 * 1e6, 1.0);
}

TEST(SetpointCertificate, DeviationFallsWithThePeriod) {
  const auto paths =
      testing::goal_paths(std::string(IMD_SOURCE_DIR) + "/config/goals/six_axis_toppra_100ms_pv.yaml");
  double before = std::numeric_limits<double>::infinity();
  for (const double period : {0.020, 0.010, 0.005}) {
    double worst = 0.0;
    for (const auto& path : paths)
      worst = std::max(worst, certify_setpoints(path, encoding(31830.0, period)).value().worst_deviation);
    EXPECT_LT(worst, before);
    before = worst;
  }
}

TEST(SetpointCertificate, RefusalNamesJointTimeDeviationAndRemedy) {
  const trajectory::Path fast =
      piece(0.2, trajectory::Polynomial{{0.0, 0.0, 0.0, 10 / 8e-3, -15 / 1.6e-3, 6 / 3.2e-4}});
  auto e = encoding(31830.0, 0.020);
  e.bound_counts = 5.0;
  const auto refused = certify_setpoints(fast, e);
  ASSERT_FALSE(refused);
  for (const char* part : {"elbow", "20 ms", "deviation_bound", "(5)", "sync_period"})
    EXPECT_NE(refused.error().text.find(part), std::string::npos) << refused.error().text;
}

TEST(SetpointCertificate, PositionsBeyondATargetPositionAreRefused) {
  const auto refused = certify_setpoints(trajectory::Path(10.0), encoding(1e9));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("0x607A"), std::string::npos) << refused.error().text;
  EXPECT_FALSE(certify_setpoints(trajectory::Path(std::nan("")), encoding(1000.0)));
}

TEST(SetpointCertificate, WrongSettingsAreRefusedByName) {
  const trajectory::Path rest(0.0);
  const auto expect_refused = [&](const SetpointEncoding& e, const char* name) {
    try {
      static_cast<void>(certify_setpoints(rest, e));
      ADD_FAILURE() << name << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  auto e = encoding(1000.0);
  e.order = 4;
  expect_refused(e, "order");
  e = encoding(1000.0);
  e.servo_period = GoalTime{0.011};
  expect_refused(e, "servo_period");
  e = encoding(1000.0, 0.0);
  expect_refused(e, "period");
  e = encoding(1000.0);
  e.bound_counts = 0.0;
  expect_refused(e, "bound_counts");
}

/// 1 rad/s from goal time 0 on, and from 0.5 s on to rest along `stop`.
trajectory::Path braking_path(const trajectory::Path& stop) {
  std::vector<trajectory::Piece> pieces{{GoalTime{0.0}, GoalTime{0.5}, {{0.0, 1.0}}}};
  pieces.insert(pieces.end(), stop.pieces().begin(), stop.pieces().end());
  return trajectory::Path(std::move(pieces));
}

/// The largest second difference of the drive's demand, from sample to sample, the demand by Lagrange's form.
double sampled_acceleration(const trajectory::Path& path, double first, double last) {
  constexpr double kPeriod = 0.010;
  constexpr int kSamples = 10;  // per period
  std::vector<double> demand;
  for (int n = 3; first + n * kPeriod < last; ++n) {
    std::vector<double> times;
    std::vector<double> values;
    for (int back = 0; back <= 3; ++back) {
      times.push_back(first + (n - back) * kPeriod);
      values.push_back(path.sample(GoalTime{times.back()}).position);
    }
    for (int i = 0; i < kSamples; ++i)
      demand.push_back(lagrange(times, values, times[1] + i * kPeriod / kSamples));
  }
  double worst = 0.0;
  for (std::size_t i = 2; i < demand.size(); ++i)
    worst = std::max(worst, std::abs(demand[i] - 2.0 * demand[i - 1] + demand[i - 2]) / 1e-6);
  return worst;
}

TEST(DemandAcceleration, IsThatOfTheDrivesSamples) {
  const SetpointEncoding e = encoding(1e6);
  const trajectory::State from{0.5, 1.0, 0.0};
  for (const double ramp : {0.02, 0.05, 0.1}) {
    const trajectory::Path path =
        braking_path(trajectory::jerk_limited_stop(from, GoalTime{0.5}, {10.0, GoalTime{ramp}}));
    for (const double first : {0.1, 0.103, 0.108}) {
      const double sampled = sampled_acceleration(path, first, 1.0);
      EXPECT_NEAR(demand_acceleration(path, GoalTime{first}, e), sampled, 0.05 * sampled)
          << ramp << ", " << first;
    }
  }
}

// A step of acceleration on a target position is one of velocity in the cubic through four of them, a sixth
// of it times the period: 10 rad/s^2 become 10 (10 / 6) between two samples of 1 ms, besides the bend of the
// cubics.
TEST(DemandAcceleration, OfAStepInAccelerationIsThatOfTheStepInVelocity) {
  trajectory::JointLimits limits;
  limits.max_acceleration = 10.0;
  const trajectory::Path path =
      braking_path(trajectory::shortest_stop_path({0.5, 1.0, 0.0}, GoalTime{0.5}, limits));
  SetpointEncoding e = encoding(1e6);
  const double found = demand_acceleration(path, GoalTime{0.4}, e);
  EXPECT_GE(found, 10.0 * 10.0 / 6.0);
  EXPECT_LE(found, 10.0 * 10.0 / 6.0 + 10.0);
  e.order = 1;
  EXPECT_NEAR(demand_acceleration(path, GoalTime{0.4}, e), 100.0, 1.0) << "0.1 rad/s within 1 ms";
}

TEST(DemandAcceleration, OfADriveThatHasTheTargetPositionsBeforeIsTheSame) {
  const SetpointEncoding e = encoding(1e6);
  const trajectory::Path path =
      braking_path(trajectory::jerk_limited_stop({0.5, 1.0, 0.0}, GoalTime{0.5}, {10.0, GoalTime{0.02}}));
  interpolation::CipKnots known;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const GoalTime time{0.4 - 0.01 * static_cast<double>(i)};
    known[i] = {time.count(), path.sample(time).position};
  }
  EXPECT_NEAR(demand_acceleration(known, GoalTime{0.41}, path.end_time() + GoalTime{0.035}, path, e),
              demand_acceleration(path, GoalTime{0.35}, e), 1e-6);
}

// The target position of 10 ms is missing, and that of 20 ms is d beside the line that the drive goes on
// along from 10 ms on: there the cubic through 20, 0, -10 and -20 ms is d (1 2 3) / (2 3 4) beside it, a
// step.
TEST(DemandAcceleration, BehindAGapIsThatOfTheStepOfTheDemand) {
  const SetpointEncoding e = encoding(1e6);
  const interpolation::CipKnots line{{{0.0, 0.0}, {-0.01, -0.01}, {-0.02, -0.02}, {-0.03, -0.03}}};
  const auto found = [&](double d) {
    const trajectory::Path beside({{GoalTime{0.0}, GoalTime{1.0}, {{d, 1.0}}}});
    return demand_acceleration(line, GoalTime{0.02}, GoalTime{0.02}, beside, e);
  };
  EXPECT_NEAR(found(0.0), 0.0, 1e-6);
  constexpr double kBeside = 0.004;
  const double step = kBeside / 4.0 / 1e-6;
  EXPECT_GE(found(kBeside), step);
  // Within the next ms the cubic goes on from d/4 to d (11 21 31) / 24000.
  EXPECT_LE(found(kBeside), step + kBeside * (11.0 * 21.0 * 31.0 / 24000.0 - 0.25) / 1e-6 + 1e-6);
}

// From constant velocity into 10 per s^2 at once: the velocity of the demand steps by a sixth of that times
// the period, and more where two cubics meet that both know of it.
TEST(AccelerationBeyond, IsFoundBehindTheJoinAlone) {
  const trajectory::Path even = piece(1.0, {{0.0, 1.0}});
  const trajectory::Path bent({{GoalTime{0.5}, GoalTime{1.0}, {{0.5, 1.0, 5.0}}}});
  SetpointEncoding e = encoding(1e6);
  e.max_acceleration = 12.0;
  const auto peak = find_acceleration_beyond(even, GoalTime{0.5}, bent, e);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->time.count(), 0.51, 1e-9);
  EXPECT_GT(peak->acceleration, 12.0);
  // What lies before the join is the drive's already.
  const trajectory::Path jump(
      {{GoalTime{0.0}, GoalTime{0.57}, {{0.0, 1.0}}}, {GoalTime{0.57}, GoalTime{1.0}, {{0.57, 9.0}}}});
  const auto before = find_acceleration_beyond(jump, GoalTime{0.3}, even, e);
  EXPECT_TRUE(before);  // its end at 1 rad/s is a step down to rest
  EXPECT_GT(before->time.count(), 0.99);
  e.order = 1;
  EXPECT_FALSE(find_acceleration_beyond(even, GoalTime{0.5}, bent, e));
}

TEST(SetpointCertificate, AccelerationBeyondTheLargestIsRefused) {
  SetpointEncoding e = encoding(1000.0);
  const trajectory::Path path =
      trajectory::Path({trajectory::rest_to_rest(0.0, 1.0, GoalTime{0.0}, GoalTime{1.0})});
  const auto found = certify_setpoints(path, e);
  ASSERT_TRUE(found) << found.error().text;
  EXPECT_NEAR(found.value().acceleration, 10.0 / std::sqrt(3.0), 0.3);
  e.max_acceleration = 0.9 * found.value().acceleration;
  const auto refused = certify_setpoints(path, e);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("limit_margin"), std::string::npos) << refused.error().text;
  e.order = 1;
  e.bound_counts = 50.0;
  EXPECT_TRUE(certify_setpoints(path, e)) << "a line has steps in velocity by nature";
}

// On a line between two target positions of a parabola the drive is a T^2 / 8 off in the middle: at 8 rad/s^2
// and 20 ms 400 counts of 1e6, of which rounding takes or adds half a one.
TEST(StreamCertificate, IsThatOfTheChordOfADriveOnLines) {
  SetpointEncoding e = encoding(1e6, 0.020);
  e.order = 1;
  const trajectory::Path parabola = piece(1.0, {{0.0, -4.0, 4.0}});
  const auto found = certify_stream_from(GoalTime{0.0}, parabola, e);
  ASSERT_TRUE(found) << found.error().text;
  EXPECT_NEAR(found.value().worst_deviation, 400.0, 1.0);
  e.bound_counts = 398.0;
  const auto refused = certify_stream_from(GoalTime{0.0}, parabola, e);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("stream_deviation_bound"), std::string::npos) << refused.error().text;
}

// A drive on lines goes on at 1 rad/s, its path at -1: 2 rad/s apart for 19 ms, as far as its samples go.
TEST(DemandDeparture, BeginsWhereTheDriveWasLeft) {
  SetpointEncoding e = encoding(1e6);
  e.order = 1;
  const interpolation::CipKnots known{{{0.0, 0.0}, {-0.01, -0.01}, {-0.02, -0.02}, {-0.03, -0.03}}};
  const trajectory::Path back = piece(1.0, {{0.0, -1.0}});
  EXPECT_NEAR(demand_departure(known, GoalTime{0.03}, GoalTime{0.03}, back, back, e), 2.0 * 0.019 * 1e6, 1.0);
}

}  // namespace
}  // namespace interpolated_motion::encoding
