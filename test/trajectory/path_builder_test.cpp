#include "interpolated_motion_driver/trajectory/path_builder.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/extrema.h"
#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/shape_preserving.h"
#include "trajectory/random.h"

namespace interpolated_motion::trajectory {
namespace {

Knot knot(double time, double p) { return {GoalTime(time), {p, 0, 0}, KnotData::Position}; }
Knot knot(double time, double p, double v) { return {GoalTime(time), {p, v, 0}, KnotData::Velocity}; }
Knot knot(double time, double p, double v, double a) {
  return {GoalTime(time), {p, v, a}, KnotData::Acceleration};
}

void expect_state(const State& actual, const State& expected, double scale) {
  EXPECT_NEAR(actual.position, expected.position, 1e-12 * scale);
  EXPECT_NEAR(actual.velocity, expected.velocity, 1e-12 * scale);
  EXPECT_NEAR(actual.acceleration, expected.acceleration, 1e-12 * scale);
}

TEST(Hermite, ReproducesPolynomialsOfItsDegree) {
  const Polynomial cubic{{1, -2, 3, -4, 0, 0}};
  const Polynomial quintic{{1, -2, 3, -4, 5, -6}};
  const Polynomial c = cubic_hermite(cubic.state(0), cubic.state(0.5), 0.5);
  const Polynomial q = quintic_hermite(quintic.state(0), quintic.state(0.5), 0.5);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(c.coefficients[i], cubic.coefficients[i], 1e-12);
    EXPECT_NEAR(q.coefficients[i], quintic.coefficients[i], 1e-11);
  }
}

TEST(ShapePreservingSlope, IsThatOfAParabolaWhereItMayBe) {
  // p = t^2 at 1, 2, 4: mean slopes 3 and 6, true slope 4 at t = 2.
  EXPECT_DOUBLE_EQ(shape_preserving_slope(1, 3, 2, 6), 4.0);
  EXPECT_DOUBLE_EQ(shape_preserving_slope(1, -3, 2, -6), -4.0);
}

TEST(ShapePreservingSlope, IsZeroAtExtremaAndLimitedBesideFlats) {
  EXPECT_EQ(shape_preserving_slope(1, 3, 2, -6), 0.0);
  EXPECT_EQ(shape_preserving_slope(1, 0, 2, 6), 0.0);
  EXPECT_DOUBLE_EQ(shape_preserving_slope(1, 0.001, 1, 6), 0.002);
}

TEST(PathBuilder, MeetsGivenStates) {
  const std::vector<Knot> knots{knot(0, 1, 0, 0), knot(0.3, 2, 3, -4), knot(0.9, -1, 0.5, 2),
                                knot(1, -1, 0, 0)};
  const Path path = build_path(knots);
  for (const Knot& k : knots) expect_state(path.sample(k.time), k.state, 100.0);
}

TEST(PathBuilder, IsCubicWhereAnAccelerationIsMissing) {
  const Path path = build_path({knot(0, 1, 0, 0), knot(1, 2, 3), knot(2, -1, 0.5, 2), knot(3, -1, 0, 0)});
  EXPECT_EQ(path.pieces()[0].polynomial.coefficients[5], 0.0);
  EXPECT_EQ(path.pieces()[1].polynomial.coefficients[5], 0.0);
  EXPECT_NE(path.pieces()[2].polynomial.coefficients[5], 0.0);
}

TEST(PathBuilder, FillsMissingVelocitiesWithoutAStep) {
  const Path path = build_path({knot(0, 0, 0), knot(1, 1), knot(2, 2), knot(3, 2.5, 0.2), knot(4, 2.5)});
  EXPECT_DOUBLE_EQ(path.sample(GoalTime(1)).velocity, 1.0);
  EXPECT_DOUBLE_EQ(path.sample(GoalTime(3)).velocity, 0.2);
  EXPECT_NEAR(path.sample(GoalTime(4)).velocity, 0.0, 1e-12);
}

TEST(PathBuilder, PositionsOnlyStartAndEndAtRest) {
  const Path path = build_path({knot(0, 0), knot(1, 1)});
  EXPECT_EQ(path.sample(GoalTime(0)).velocity, 0.0);
  EXPECT_DOUBLE_EQ(path.sample(GoalTime(0.5)).velocity, 1.5);
  EXPECT_NEAR(path.sample(GoalTime(1)).velocity, 0.0, 1e-15);
}

TEST(PathBuilder, RefusesTooFewKnotsAndTimesThatDoNotIncrease) {
  EXPECT_THROW(build_path({}), std::invalid_argument);
  EXPECT_THROW(build_path({knot(0, 1)}), std::invalid_argument);
  EXPECT_THROW(build_path({knot(1, 1), knot(1, 2)}), std::invalid_argument);
  EXPECT_THROW(build_path({knot(1, 1), knot(0, 2)}), std::invalid_argument);
}

/// Random knots of spacings from 1 ms to seconds, with flats and repeated positions among them.
std::vector<Knot> random_knots(Random& random, int kinds) {
  std::vector<Knot> knots;
  double time = 0.0;
  double position = 0.0;
  const int count = random.integer(2, 40);
  for (int i = 0; i < count; ++i) {
    Knot k = knot(time, position, random.uniform(-2, 2), random.uniform(-9, 9));
    k.given = static_cast<KnotData>(random.integer(0, kinds - 1));
    knots.push_back(k);
    time += std::pow(10.0, random.uniform(-3, 1));
    if (random.integer(0, 3) > 0) position += random.uniform(-1, 1);
  }
  return knots;
}

TEST(PathBuilderProperty, MeetsEveryKnotWithContinuousPositionAndVelocity) {
  Random random(1);
  for (int n = 0; n < property_cases(500); ++n) {
    const auto knots = random_knots(random, 3);
    const Path path = build_path(knots);
    ASSERT_EQ(path.pieces().size() + 1, knots.size());
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const Piece& piece = path.pieces()[i];
      const State end = piece.polynomial.state(piece.duration().count());
      const State next = i + 2 < knots.size() ? path.pieces()[i + 1].polynomial.state(0)
                                              : State{knots.back().state.position, end.velocity, 0};
      const double mean =
          std::abs(knots[i + 1].state.position - knots[i].state.position) / piece.duration().count();
      const double speed = 20.0 + 10.0 * mean + 10.0 * piece.duration().count();
      EXPECT_EQ(piece.polynomial.position(0), knots[i].state.position);
      EXPECT_NEAR(end.position, knots[i + 1].state.position, 1e-12 * (1 + speed * piece.duration().count()));
      EXPECT_NEAR(end.position, next.position, 1e-12 * (1 + speed * piece.duration().count()));
      EXPECT_NEAR(end.velocity, next.velocity, 1e-12 * speed);
      if (knots[i].given != KnotData::Position) {
        EXPECT_EQ(piece.polynomial.velocity(0), knots[i].state.velocity);
      }
    }
  }
}

TEST(PathBuilderProperty, PositionsOnlyNeverLeaveTheRangeOfTheirKnots) {
  Random random(2);
  for (int n = 0; n < property_cases(500); ++n) {
    const auto knots = random_knots(random, 1);
    const Path path = build_path(knots);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const Piece& piece = path.pieces()[i];
      const double a = knots[i].state.position;
      const double b = knots[i + 1].state.position;
      for (int k = 0; k <= 50; ++k) {
        const double p = piece.polynomial.position(piece.duration().count() * k / 50.0);
        EXPECT_GE(p, std::min(a, b) - 1e-12);
        EXPECT_LE(p, std::max(a, b) + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::trajectory
