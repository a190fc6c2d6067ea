#include "interpolated_motion_driver/interpolation/cip_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace interpolated_motion::interpolation {
namespace {

/// Numbers in [-1, 1), the same on every platform.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) / 4503599627370496.0 - 1.0; }

 private:
  std::mt19937_64 engine_;
};

/// Knots with random values, the newest at time 1, spacings between 0.5 and 1.5 of `period`.
CipKnots irregular_knots(Uniform& uniform, double period) {
  CipKnots knots;
  double time = 1.0;
  for (CipKnot& knot : knots) {
    knot = {time, 100 * uniform()};
    time -= period * (1.0 + 0.5 * uniform());
  }
  return knots;
}

// By hand: T = 2, P = 10, 4, 1, 0: dP = 6, dV = 3, dA = 1.
TEST(CipPolynomial, PositionCoefficientsOfTheTable) {
  const CipValues p{10, 4, 1, 0};
  const CipPolynomial third = cip_position_polynomial(3, 2.0, p);
  EXPECT_DOUBLE_EQ(third.a[0], 4.0);
  EXPECT_DOUBLE_EQ(third.a[1], 13.0 / 6.0);
  EXPECT_DOUBLE_EQ(third.a[2], 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(third.a[3], 1.0 / 48.0);
  const CipPolynomial second = cip_position_polynomial(2, 2.0, p);
  EXPECT_DOUBLE_EQ(second.a[1], 9.0 / 4.0);
  EXPECT_DOUBLE_EQ(second.a[2], 3.0 / 8.0);
  EXPECT_EQ(second.a[3], 0.0);
  const CipPolynomial first = cip_position_polynomial(1, 2.0, p);
  EXPECT_DOUBLE_EQ(first.a[1], 3.0);
  EXPECT_EQ(first.a[2], 0.0);
}

// By hand: T = 2, V = 10, 4, 1: dV = 6, dA = 6 - 3 = 3.
TEST(CipPolynomial, VelocityAndAccelerationCoefficientsOfTheTable) {
  const CipPolynomial velocity = cip_velocity_polynomial(2, 2.0, {10, 4, 1, 0});
  EXPECT_DOUBLE_EQ(velocity.a[0], 4.0);
  EXPECT_DOUBLE_EQ(velocity.a[1], 9.0 / 4.0);
  EXPECT_DOUBLE_EQ(velocity.a[2], 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(cip_velocity_polynomial(1, 2.0, {10, 4, 1, 0}).a[1], 3.0);
  const CipPolynomial acceleration = cip_acceleration_polynomial(2.0, {10, 4, 0, 0});
  EXPECT_DOUBLE_EQ(acceleration.a[0], 4.0);
  EXPECT_DOUBLE_EQ(acceleration.a[1], 3.0);
}

TEST(CipPolynomial, VelocityCoefficientAsPrintedMissesTheNewestCommand) {
  const double t = 2.0;
  const double printed_b1 = (10 - 3.0 / 2) / t;  // "1/T * (V - 1/2 dA)"
  EXPECT_DOUBLE_EQ(4 + printed_b1 * t + 3.0 / 8.0 * t * t, 14.0);
  EXPECT_DOUBLE_EQ(cip_velocity_polynomial(2, t, {10, 4, 1, 0}).value(t), 10.0);
}

TEST(CipPolynomial, PassesThroughTheLastCommands) {
  Uniform uniform(1);
  for (int n = 0; n < 1000; ++n) {
    const double t = 0.011 + 0.01 * uniform();
    const CipValues p{uniform(), uniform(), uniform(), uniform()};
    for (int order = 1; order <= 3; ++order) {
      const CipPolynomial polynomial = cip_position_polynomial(order, t, p);
      for (int i = 0; i <= order; ++i) {
        EXPECT_NEAR(polynomial.value((1 - i) * t), p[static_cast<std::size_t>(i)], 1e-13);
      }
    }
    for (int i = 0; i <= 2; ++i) {
      EXPECT_NEAR(cip_velocity_polynomial(2, t, p).value((1 - i) * t), p[static_cast<std::size_t>(i)], 1e-13);
    }
  }
}

TEST(CipPolynomial, CubicPositionAndQuadraticVelocityAreExact) {
  const double t = 0.02;
  const auto cubic = [](double x) { return 3 - 2 * x + 5 * x * x - 40 * x * x * x; };
  const auto cubic_rate = [](double x) { return -2 + 10 * x - 120 * x * x; };
  const CipValues p{cubic(t), cubic(0), cubic(-t), cubic(-2 * t)};
  const CipValues v{cubic_rate(t), cubic_rate(0), cubic_rate(-t), 0};
  const CipPolynomial position = cip_position_polynomial(3, t, p);
  const CipPolynomial velocity = cip_velocity_polynomial(2, t, v);
  for (double x = 0; x <= 5 * t; x += 0.001) {
    EXPECT_NEAR(position.value(x), cubic(x), 1e-12);
    EXPECT_NEAR(position.first_derivative(x), cubic_rate(x), 1e-10);
    EXPECT_NEAR(position.second_derivative(x), 10 - 240 * x, 1e-8);
    EXPECT_NEAR(velocity.value(x), cubic_rate(x), 1e-12);
    EXPECT_NEAR(velocity.first_derivative(x), 10 - 240 * x, 1e-10);
  }
}

TEST(CipPolynomial, DividedDifferencesAreTheTableAtAConstantPeriod) {
  Uniform uniform(2);
  for (int n = 0; n < 1000; ++n) {
    const double t = 0.0125 + 0.0075 * uniform();
    const CipValues p{uniform(), uniform(), uniform(), uniform()};
    const CipKnots knots{{{t, p[0]}, {0, p[1]}, {-t, p[2]}, {-2 * t, p[3]}}};
    for (int order = 1; order <= 3; ++order) {
      const CipPolynomial table = cip_position_polynomial(order, t, p);
      const CipPolynomial newton = cip_polynomial_through(order, knots);
      double scale = 1.0;
      for (std::size_t i = 0; i < kCipHistory; ++i, scale /= t) {
        EXPECT_NEAR(newton.a[i], table.a[i], 1e-14 * scale) << "a" << i << " of order " << order;
      }
    }
    const CipPolynomial velocity = cip_velocity_polynomial(2, t, p);
    const CipPolynomial newton = cip_polynomial_through(2, knots);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(newton.a[i], velocity.a[i], 1e-14 * std::pow(t, -2.0));
  }
}

TEST(CipPolynomial, PassesThroughIrregularCommands) {
  Uniform uniform(3);
  for (int n = 0; n < 1000; ++n) {
    const CipKnots knots = irregular_knots(uniform, 0.02);
    for (int order = 1; order <= 3; ++order) {
      const CipPolynomial polynomial = cip_polynomial_through(order, knots);
      for (std::size_t i = 0; i <= static_cast<std::size_t>(order); ++i) {
        EXPECT_NEAR(polynomial.value(knots[i].time - knots[1].time), knots[i].value, 1e-10);
      }
    }
  }
}

TEST(CipPolynomial, CubicIsExactThroughIrregularCommands) {
  Uniform uniform(4);
  const auto cubic = [](double x) { return 3 - 2 * x + 5 * x * x - 40 * x * x * x; };
  for (int n = 0; n < 100; ++n) {
    CipKnots knots = irregular_knots(uniform, 0.02);
    for (CipKnot& knot : knots) knot.value = cubic(knot.time);
    const CipPolynomial polynomial = cip_polynomial_through(3, knots);
    for (double tau = 0; tau <= 0.1; tau += 0.01) {
      EXPECT_NEAR(polynomial.value(tau), cubic(knots[1].time + tau), 1e-10);
    }
  }
}

// From one segment to the next the position is continuous; the velocity steps by the first difference the
// order leaves out, over order times T.
TEST(CipPolynomial, VelocityStepBetweenSegmentsIsTheNextDifference) {
  Uniform uniform(5);
  const double t = 0.02;
  for (int n = 0; n < 100; ++n) {
    const double p[] = {uniform(), uniform(), uniform(), uniform(), uniform()};
    const double difference[] = {0, p[0] - 2 * p[1] + p[2], p[0] - 3 * p[1] + 3 * p[2] - p[3],
                                 p[0] - 4 * p[1] + 6 * p[2] - 4 * p[3] + p[4]};
    for (int order = 1; order <= 3; ++order) {
      const CipPolynomial before = cip_position_polynomial(order, t, {p[1], p[2], p[3], p[4]});
      const CipPolynomial after = cip_position_polynomial(order, t, {p[0], p[1], p[2], p[3]});
      EXPECT_NEAR(after.value(0), before.value(t), 1e-14);
      EXPECT_NEAR(after.first_derivative(0) - before.first_derivative(t), difference[order] / (order * t),
                  1e-11);
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::interpolation
