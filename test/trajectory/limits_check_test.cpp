#include "interpolated_motion_driver/trajectory/limits_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/path_builder.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"
#include "trajectory/goals.h"
#include "trajectory/random.h"

namespace interpolated_motion::trajectory {
namespace {

/// From 0 to 1 in 1 s: peak velocity 1.875 at 0.5 s, peak acceleration 5.7735 at 0.2113 s.
Path unit_move() { return Path({rest_to_rest(0, 1, GoalTime(0), GoalTime(1))}); }

TEST(LimitsCheck, PassesWithoutLimitsAndAtTheLimit) {
  EXPECT_FALSE(find_limit_violation(unit_move(), {}));
  JointLimits exact;
  exact.min_position = 0.0;
  exact.max_position = 1.0;
  exact.max_velocity = 1.875;
  exact.max_acceleration = 10.0 / std::sqrt(3.0);
  EXPECT_FALSE(find_limit_violation(unit_move(), exact));
}

TEST(LimitsCheck, FindsAVelocityBetweenTheKnots) {
  JointLimits limits;
  limits.max_velocity = 1.87;
  const auto violation = find_limit_violation(unit_move(), limits);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->quantity, Quantity::Velocity);
  EXPECT_NEAR(violation->value, 1.875, 1e-12);
  EXPECT_NEAR(violation->time.count(), 0.5, 1e-9);
  EXPECT_EQ(violation->maximum, 1.87);
}

TEST(LimitsCheck, FindsAnAcceleration) {
  JointLimits limits;
  limits.max_acceleration = 5.77;
  const auto violation = find_limit_violation(unit_move(), limits);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->quantity, Quantity::Acceleration);
  EXPECT_NEAR(std::abs(violation->value), 10.0 / std::sqrt(3.0), 1e-9);
}

/// Rest to rest through `positions`, a second each.
Path through(const std::vector<double>& positions) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
    const auto start = static_cast<double>(i);
    pieces.push_back(rest_to_rest(positions[i], positions[i + 1], GoalTime(start), GoalTime(1)));
  }
  return Path(std::move(pieces));
}

JointLimits between(double low, double high) {
  JointLimits limits;
  limits.min_position = low;
  limits.max_position = high;
  return limits;
}

TEST(LimitsCheck, SaysWhetherItIsRoundingAKnotOrBetweenKnots) {
  JointLimits limits;
  limits.max_velocity = 1.875 / 1.02;
  const auto text_of = [&limits](const Path& path) {
    return limit_refusal("elbow", JointUnit::Radian, *find_limit_violation(path, limits)).text;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(text_of(unit_move()), "It is 2 % more, as rounding")) << text_of(unit_move());
  EXPECT_TRUE(has(text_of(unit_move()), "give the planner 0.98 of them, or raise plan_margin"))
      << text_of(unit_move());
  limits.max_velocity = 1.5;
  EXPECT_TRUE(has(text_of(unit_move()), "The curve between two points")) << text_of(unit_move());
  EXPECT_TRUE(has(text_of(unit_move()), "by a factor of 1.25"));
  const Piece fast_end{GoalTime(0), GoalTime(1), Polynomial{{0.0, 0.0, 1.0, 0.0, 0.0, 0.0}}};
  EXPECT_TRUE(has(text_of(Path({fast_end})), "A point asks for it itself")) << text_of(Path({fast_end}));
}

TEST(LimitsCheck, LeavesThePlanItsMargin) {
  JointLimits limits;
  limits.max_velocity = 1.875 / 1.009;
  limits.max_acceleration = 10.0 / std::sqrt(3.0) / 1.009;
  EXPECT_TRUE(find_limit_violation(unit_move(), limits));
  limits.rate_slack = 0.01;
  EXPECT_FALSE(find_limit_violation(unit_move(), limits));
  limits.rate_slack = 0.008;
  EXPECT_TRUE(find_limit_violation(unit_move(), limits));
}

TEST(LimitsCheck, LeavesTheSlackOfTheJoint) {
  JointLimits limits = between(0.0, 1.0);
  EXPECT_TRUE(find_limit_violation(through({0.5, 1.00005, 0.5}), limits));
  limits.position_slack = 6e-5;
  EXPECT_FALSE(find_limit_violation(through({0.5, 1.00005, 0.5}), limits));
  EXPECT_FALSE(find_limit_violation(through({0.5, -0.00005, 0.5}), limits));
  EXPECT_TRUE(find_limit_violation(through({0.5, 1.00007, 0.5}), limits));
  EXPECT_TRUE(find_limit_violation(through({0.5, -0.00007, 0.5}), limits));
}

TEST(LimitsCheck, LetsAJointThatStandsOutsideMoveInOrStay) {
  const JointLimits limits = between(0.0, 1.0);
  for (const auto& inwards : std::vector<std::vector<double>>{{-0.2, 0.5},
                                                              {-0.2, -0.2, 0.5},
                                                              {-0.2, -0.1},
                                                              {-0.2, -0.2},
                                                              {-0.2, -0.1, 0.0, 1.0, 0.0},
                                                              {1.3, 0.5},
                                                              {1.3, 1.2, 1.2, 1.1},
                                                              {1.3, 1.3},
                                                              {1.3, 0.0, 1.0}}) {
    EXPECT_FALSE(find_limit_violation(through(inwards), limits)) << ::testing::PrintToString(inwards);
  }
}

TEST(LimitsCheck, LetsNoJointThatStandsOutsideMoveFartherOutOrOutAgain) {
  const JointLimits limits = between(0.0, 1.0);
  for (const auto& outwards : std::vector<std::vector<double>>{{-0.2, -0.21},
                                                               {-0.2, -0.1, -0.15},
                                                               {-0.2, 0.5, -0.1},
                                                               {-0.2, 1.1},
                                                               {-0.2, -0.1, 0.0, -0.1},
                                                               {1.3, 1.31},
                                                               {1.3, 0.5, 1.1},
                                                               {1.3, 1.1, 1.2},
                                                               {1.3, -0.1}}) {
    const auto violation = find_limit_violation(through(outwards), limits);
    ASSERT_TRUE(violation) << ::testing::PrintToString(outwards);
    EXPECT_EQ(violation->quantity, Quantity::Position);
    EXPECT_EQ(violation->maximum, 1.0);
  }
}

// One piece of degree 5 that sets out inwards, turns while it is outside and comes in at last.
TEST(LimitsCheck, FindsATurnWithinAPieceThatBeginsOutside) {
  const Piece straight{GoalTime(0), GoalTime(1), Polynomial{{-0.2, 0.3, 0.0, 0.0, 0.0, 0.0}}};
  const Piece turns{GoalTime(0), GoalTime(1), Polynomial{{-0.2, 0.3, -1.2, 1.5, 0.0, 0.0}}};
  ASSERT_LT(turns.polynomial.position(0.3), turns.polynomial.position(0.2));
  EXPECT_FALSE(find_limit_violation(Path({straight}), between(0.0, 1.0)));
  const auto violation = find_limit_violation(Path({turns}), between(0.0, 1.0));
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->begins_outside, -0.2);
  EXPECT_NE(limit_refusal("elbow", JointUnit::Radian, *violation).text.find("stands outside, at -0.2"),
            std::string::npos);
}

TEST(LimitsCheck, HoldsTheOtherLimitsOnTheWayIn) {
  JointLimits limits = between(0.0, 1.0);
  limits.max_velocity = 0.5;
  const auto violation = find_limit_violation(through({-0.2, 0.5}), limits);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->quantity, Quantity::Velocity);
}

TEST(LimitsCheck, FindsAPositionUnlessTheJointIsContinuous) {
  JointLimits limits;
  limits.max_position = 0.99;
  ASSERT_TRUE(find_limit_violation(unit_move(), limits));
  EXPECT_EQ(find_limit_violation(unit_move(), limits)->quantity, Quantity::Position);
  limits.min_position = 0.01;
  limits.continuous = true;
  EXPECT_FALSE(find_limit_violation(unit_move(), limits));
  EXPECT_FALSE(find_limit_violation(Path({rest_to_rest(0, -9, GoalTime(0), GoalTime(1))}), limits));
}

TEST(LimitsCheck, ToleratesPlannersNoiseOnly) {
  JointLimits limits;
  limits.max_velocity = 1.875 / 1.00001;
  EXPECT_FALSE(find_limit_violation(unit_move(), limits));
  limits.max_velocity = 1.875 / 1.001;
  EXPECT_TRUE(find_limit_violation(unit_move(), limits));
}

TEST(LimitsCheck, TakesNotANumberForAViolation) {
  Piece piece = rest_to_rest(0, 1, GoalTime(0), GoalTime(1));
  piece.polynomial.coefficients[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(find_limit_violation(Path({piece}), {}));
}

TEST(LimitsCheck, SaysWhatToDo) {
  JointLimits limits;
  limits.max_velocity = 1.0;
  const Refusal refusal =
      limit_refusal("elbow", JointUnit::Radian, *find_limit_violation(unit_move(), limits));
  EXPECT_EQ(refusal.code, GoalError::InvalidGoal);
  EXPECT_EQ(
      refusal.text,
      "elbow: the velocity reaches 1.875 rad/s at 0.500000 s, allowed is -1 to 1 rad/s. The curve between "
      "two points does: give accelerations with the points, or more points. Slow the trajectory down "
      "by a factor of 1.875 or more, or correct the joint's limits.");
}

/// Largest of `value` over samples of a piece.
template <class Value>
double sampled_maximum(const Piece& piece, const Value& value) {
  double result = value(piece.polynomial.state(0));
  for (int i = 1; i <= 1000; ++i) {
    result = std::max(result, value(piece.polynomial.state(piece.duration().count() * i / 1000.0)));
  }
  return result;
}

TEST(LimitsCheckProperty, SeparatesLimitsJustAboveAndJustBelowThePeak) {
  Random random(9);
  for (int n = 0; n < property_cases(500); ++n) {
    Piece piece{GoalTime(0), GoalTime(random.uniform(0.2, 1)), {}};
    for (double& c : piece.polynomial.coefficients) c = random.uniform(-1, 1);
    const Path path({piece});
    const double position = sampled_maximum(piece, [](const State& s) { return s.position; });
    const double velocity = sampled_maximum(piece, [](const State& s) { return std::abs(s.velocity); });
    const double acceleration =
        sampled_maximum(piece, [](const State& s) { return std::abs(s.acceleration); });
    for (const bool inside : {true, false}) {
      const double factor = inside ? 1.001 : 0.999;
      JointLimits limits;
      limits.max_position = position + (inside ? 0.001 : -0.001);
      const bool begins_outside = piece.polynomial.position(0.0) > limits.max_position;
      if (!begins_outside) {
        EXPECT_EQ(find_limit_violation(path, limits).has_value(), !inside);
      }
      EXPECT_EQ(find_limit_violation(path, limits_of(factor * velocity, 1e9)).has_value(), !inside);
      EXPECT_EQ(find_limit_violation(path, limits_of(1e9, factor * acceleration)).has_value(), !inside);
    }
  }
}

/// Whether samples of the path at 400 instants a piece are outside by more than `margin`, or farther outside
/// than one before was.
bool sampled_outside(const Path& path, const JointLimits& limits, double margin) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Piece& piece : path.pieces()) {
    for (int i = 0; i <= 400; ++i) {
      const State s = piece.polynomial.state(piece.duration().count() * i / 400.0);
      lowest = std::min(lowest, s.position);
      highest = std::max(highest, s.position);
      if (s.position > std::max(limits.max_position, lowest) + margin) return true;
      if (s.position < std::min(limits.min_position, highest) - margin) return true;
      if (std::abs(s.velocity) > limits.max_velocity * (1 + margin)) return true;
      if (std::abs(s.acceleration) > limits.max_acceleration * (1 + margin)) return true;
    }
  }
  return false;
}

TEST(LimitsCheckProperty, AgreesWithDenseSampling) {
  Random random(5);
  int outside = 0;
  int cases = property_cases(500);
  for (int n = 0; n < cases; ++n) {
    std::vector<Knot> knots;
    knots.reserve(6);
    for (int i = 0; i < 6; ++i) {
      knots.push_back({GoalTime(0.5 * i),
                       {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-5, 5)},
                       static_cast<KnotData>(random.integer(0, 2))});
    }
    const Path path = build_path(knots);
    JointLimits limits;
    limits.min_position = -1.1;
    limits.max_position = random.uniform(0.9, 1.5);
    limits.max_velocity = random.uniform(3, 8);
    limits.max_acceleration = random.uniform(20, 60);
    const bool found = find_limit_violation(path, limits).has_value();
    if (sampled_outside(path, limits, 2e-4)) {
      EXPECT_TRUE(found);
    }
    if (!sampled_outside(path, limits, -1e-3)) {
      EXPECT_FALSE(found);
    }
    outside += found ? 1 : 0;
  }
  EXPECT_GT(outside, cases / 10);
  EXPECT_LT(outside, cases * 9 / 10);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
