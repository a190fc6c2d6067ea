#include "interpolated_motion_driver/trajectory/extrema.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/roots.h"
#include "trajectory/random.h"

namespace interpolated_motion::trajectory {
namespace {

/// Coefficients of the product of (x - root) over four roots.
Coefficients<4> with_roots(const std::array<double, 4>& roots) {
  Coefficients<4> c{1, 0, 0, 0, 0};
  for (const double root : roots) {
    Coefficients<4> next{};
    for (std::size_t i = 0; i < 5; ++i) {
      next[i] -= root * c[i];
      if (i > 0) next[i] += c[i - 1];
    }
    c = next;
  }
  return c;
}

TEST(SignChanges, FindsAllFourRoots) {
  const auto roots = sign_changes<4>(with_roots({0.1, 0.35, 0.7, 0.9}));
  ASSERT_EQ(roots.count, 4u);
  EXPECT_NEAR(roots.values[0], 0.1, 1e-13);
  EXPECT_NEAR(roots.values[1], 0.35, 1e-13);
  EXPECT_NEAR(roots.values[2], 0.7, 1e-13);
  EXPECT_NEAR(roots.values[3], 0.9, 1e-13);
}

TEST(SignChanges, LooksWithinTheUnitIntervalOnly) {
  const auto roots = sign_changes<4>(with_roots({-0.5, 0.25, 1.5, 3}));
  ASSERT_EQ(roots.count, 1u);
  EXPECT_NEAR(roots.values[0], 0.25, 1e-14);
}

TEST(SignChanges, FindsTripleAndNeighbouringRoots) {
  const auto triple = sign_changes<4>(with_roots({0.5, 0.5, 0.5, 2}));
  ASSERT_GE(triple.count, 1u);
  EXPECT_NEAR(triple.values[0], 0.5, 1e-5);
  const auto close = sign_changes<4>(with_roots({0.5, 0.5001, 0.9, 2}));
  ASSERT_EQ(close.count, 3u);
  EXPECT_NEAR(close.values[0], 0.5, 1e-10);
  EXPECT_NEAR(close.values[1], 0.5001, 1e-10);
}

TEST(SignChanges, DoesNotNeedTheFullDegree) {
  EXPECT_EQ(sign_changes<4>({-0.5, 1, 0, 0, 0}).count, 1u);
  EXPECT_NEAR(sign_changes<4>({-0.25, 0, 1, 0, 0}).values[0], 0.5, 1e-15);
  EXPECT_EQ(sign_changes<4>({1, 0, 0, 0, 0}).count, 0u);
  EXPECT_NEAR(sign_changes<4>({-0.25, 0, 1, 1e-300, 1e-300}).values[0], 0.5, 1e-15);
}

TEST(Extrema, OfARestToRestQuintic) {
  // From 0 to 1 in 1 s: peak velocity 15/8 at 1/2, peak accelerations +-10/sqrt(3) at 1/2 -+ sqrt(3)/6.
  const Polynomial p{{0, 0, 0, 10, -15, 6}};
  const Range velocity = velocity_range(p, 0, 1);
  EXPECT_DOUBLE_EQ(velocity.maximum.value, 15.0 / 8.0);
  EXPECT_NEAR(velocity.maximum.time, 0.5, 1e-9);
  EXPECT_NEAR(velocity.minimum.value, 0.0, 1e-14);
  const Range acceleration = acceleration_range(p, 0, 1);
  EXPECT_NEAR(acceleration.maximum.value, 10.0 / std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(acceleration.maximum.time, 0.5 - std::sqrt(3.0) / 6.0, 1e-14);
  EXPECT_NEAR(acceleration.minimum.value, -10.0 / std::sqrt(3.0), 1e-13);
  const Range position = position_range(p, 0, 1);
  EXPECT_EQ(position.minimum.value, 0.0);
  EXPECT_NEAR(position.maximum.value, 1.0, 1e-15);
}

TEST(Extrema, LooksWithinTheIntervalAsked) {
  const Polynomial p{{0, 0, 0, 10, -15, 6}};
  EXPECT_DOUBLE_EQ(velocity_range(p, 0.1, 0.4).maximum.value, p.velocity(0.4));
  EXPECT_NEAR(velocity_range(p, 0.4, 0.9).maximum.value, 15.0 / 8.0, 1e-14);
  EXPECT_DOUBLE_EQ(position_range(p, 0.2, 0.2).maximum.value, p.position(0.2));
}

/// Largest value of f at `steps` + 1 samples.
template <class F>
double sampled_maximum(const F& f, double from, double to, int steps) {
  double result = f(from);
  for (int i = 1; i <= steps; ++i) result = std::max(result, f(from + (to - from) * i / steps));
  return result;
}

/// The exact maximum is no less than any sample and, the function being smooth, not much more.
template <class F>
void expect_maximum(const F& f, const Extremum& found, double from, double to, double curvature) {
  constexpr int kSteps = 1000;
  const double sampled = sampled_maximum(f, from, to, kSteps);
  const double step = (to - from) / kSteps;
  const double rounding = 1e-12 * (1.0 + std::abs(sampled));
  EXPECT_GE(found.value, sampled - rounding);
  EXPECT_LE(found.value, sampled + curvature * step * step / 8.0 + rounding);
  EXPECT_NEAR(f(found.time), found.value, rounding);
  EXPECT_GE(found.time, from);
  EXPECT_LE(found.time, to);
}

TEST(ExtremaProperty, AgreesWithDenseSampling) {
  Random random(3);
  for (int n = 0; n < property_cases(300); ++n) {
    Polynomial p;
    for (double& c : p.coefficients) c = random.integer(0, 4) == 0 ? 0.0 : random.uniform(-1, 1);
    const double from = random.uniform(0, 1);
    const double to = from + random.uniform(0.01, 1.5);
    Polynomial minus = p;
    for (double& c : minus.coefficients) c = -c;
    // |d^k/dt^k| is at most the sum of the coefficients' own parts at t = 2.5.
    const double curvature = 20.0 * 2.5 * 2.5 * 2.5 * 10.0;
    expect_maximum([&](double t) { return p.position(t); }, position_range(p, from, to).maximum, from, to,
                   curvature);
    expect_maximum([&](double t) { return p.velocity(t); }, velocity_range(p, from, to).maximum, from, to,
                   curvature);
    expect_maximum([&](double t) { return p.acceleration(t); }, acceleration_range(p, from, to).maximum, from,
                   to, curvature);
    EXPECT_EQ(position_range(p, from, to).minimum.value, -position_range(minus, from, to).maximum.value);
    EXPECT_EQ(velocity_range(p, from, to).minimum.value, -velocity_range(minus, from, to).maximum.value);
    EXPECT_EQ(acceleration_range(p, from, to).minimum.value,
              -acceleration_range(minus, from, to).maximum.value);
  }
}

TEST(ExtremaProperty, FindsPlacedExtremaOfThePosition) {
  Random random(4);
  for (int n = 0; n < property_cases(1000); ++n) {
    std::array<double, 4> roots{};
    for (double& root : roots) root = random.uniform(0.05, 0.95);
    const Coefficients<4> velocity = with_roots(roots);
    Polynomial p;
    for (std::size_t i = 0; i < 5; ++i) p.coefficients[i + 1] = velocity[i] / static_cast<double>(i + 1);
    double highest = std::max(p.position(0), p.position(1));
    double lowest = std::min(p.position(0), p.position(1));
    for (const double root : roots) {
      highest = std::max(highest, p.position(root));
      lowest = std::min(lowest, p.position(root));
    }
    EXPECT_NEAR(position_range(p, 0, 1).maximum.value, highest, 1e-15);
    EXPECT_NEAR(position_range(p, 0, 1).minimum.value, lowest, 1e-15);
  }
}

}  // namespace
}  // namespace interpolated_motion::trajectory
