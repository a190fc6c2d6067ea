#include "interpolated_motion_driver/encoding/setpoint_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "encoding/goal_paths.h"

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

}  // namespace
}  // namespace interpolated_motion::encoding
