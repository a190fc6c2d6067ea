#include "interpolated_motion_driver/trajectory/stream_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace interpolated_motion::trajectory {
namespace {

StreamRules rules() {
  StreamRules r;
  r.limits.min_position = -3.0;
  r.limits.max_position = 3.0;
  r.limits.max_velocity = 2.0;
  r.limits.max_acceleration = 10.0;
  r.ride_through = GoalTime{0.1};
  r.catch_up = GoalTime{0.5};
  return r;
}

GoalTime at(double t) { return GoalTime{t}; }

TEST(StreamPath, PassesTheSetpointAndComesToRestAsPredicted) {
  const auto path = stream_path({1.0, 1.0, 0.0}, at(5.0), {at(5.1), 1.1, 1.0}, rules());
  ASSERT_TRUE(path);
  EXPECT_EQ(path.value().start_time(), at(5.0));
  EXPECT_NEAR(path.value().sample(at(5.1)).position, 1.1, 1e-12);
  EXPECT_NEAR(path.value().sample(at(5.1)).velocity, 1.0, 1e-12);
  EXPECT_NEAR(path.value().sample(at(5.2)).position, 1.2, 1e-12);  // rides through at 1 rad/s
  // A smooth stop takes 1.5 v / a, and half of that times v.
  EXPECT_NEAR((path.value().end_time() - at(5.2)).count(), 0.15, 1e-9);
  EXPECT_NEAR(path.value().final_position(), 1.2 + 0.075, 1e-9);
}

TEST(StreamPath, LateSetpointIsMetWhereTheStreamIsByThen) {
  // 0.05 rad behind a stream at 1 rad/s that was due 20 ms ago.
  const auto path = stream_path({0.0, 1.0, 0.0}, at(1.02), {at(1.0), 0.03, 1.0}, rules());
  ASSERT_TRUE(path);
  const GoalTime meets = path.value().pieces().front().end;
  EXPECT_GT(meets, at(1.02));
  const State there = path.value().sample(meets);
  EXPECT_NEAR(there.position, 0.03 + (meets - at(1.0)).count(), 1e-12);
  EXPECT_NEAR(there.velocity, 1.0, 1e-12);
}

TEST(StreamPath, WhatCannotBeCaughtUpIsRefusedWithTheLimit) {
  const auto path = stream_path({0.0, 0.0, 0.0}, at(0.0), {at(0.05), 2.5, 0.0}, rules());
  ASSERT_FALSE(path);
  EXPECT_NE(path.error().quantity, Quantity::Position);
  const auto beyond = stream_path({2.9, 0.0, 0.0}, at(0.0), {at(0.5), 3.1, 0.0}, rules());
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().quantity, Quantity::Position);
}

TEST(StreamPath, StopsShorterBeforeALimitOfPosition) {
  // 0.06 rad are left at 1 rad/s: no ride-through, and a smooth stop would take 0.075, full deceleration
  // 0.05.
  const auto path = stream_path({2.84, 1.0, 0.0}, at(0.0), {at(0.1), 2.94, 1.0}, rules());
  ASSERT_TRUE(path);
  EXPECT_NEAR(path.value().final_position(), 2.99, 1e-9);
}

TEST(StreamPath, NeverLeavesTheLimitsWhateverComes) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int accepted = 0;
  for (int i = 0; i < 2000; ++i) {
    const State from{2.5 * unit(random), 1.5 * unit(random), 0.0};
    const double ahead = 0.06 * unit(random);
    const StreamTarget target{at(1.0 + ahead), from.position + 0.1 * unit(random), 1.5 * unit(random)};
    const auto path = stream_path(from, at(1.0), target, rules());
    if (!path) continue;
    ++accepted;
    EXPECT_FALSE(find_limit_violation(path.value(), rules().limits)) << i;
    EXPECT_NEAR(path.value().sample(at(1.0)).velocity, from.velocity, 1e-12) << i;
    EXPECT_EQ(path.value().sample(path.value().end_time() + at(1.0)).velocity, 0.0) << i;
    // Continuous, looked at from both sides of each knot.
    const auto& pieces = path.value().pieces();
    for (std::size_t k = 1; k < pieces.size(); ++k) {
      const State before = pieces[k - 1].polynomial.state(pieces[k - 1].duration().count());
      const State after = pieces[k].polynomial.state(0.0);
      EXPECT_NEAR(before.position, after.position, 1e-9) << i;
      EXPECT_NEAR(before.velocity, after.velocity, 1e-9) << i;
    }
  }
  EXPECT_GT(accepted, 500);
}

LimitViolation acceleration_violation(GoalTime time, double value) {
  LimitViolation violation;
  violation.quantity = Quantity::Acceleration;
  violation.time = time;
  violation.value = value;
  return violation;
}

/// Of a drive that follows no step of acceleration of more than 1 rad/s^2.
std::optional<LimitViolation> step_of_acceleration(const Path& path, double from) {
  for (const Piece& piece : path.pieces()) {
    const double step = piece.polynomial.state(0.0).acceleration - from;
    if (std::abs(step) > 1.0) return acceleration_violation(piece.start, step);
    from = piece.polynomial.state(piece.duration().count()).acceleration;
  }
  return std::nullopt;
}

TEST(StreamPath, AccelerationHasNoStepWhereTheDriveFollowsNone) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int accepted = 0;
  for (int i = 0; i < 2000; ++i) {
    const State from{2.0 * unit(random), 1.2 * unit(random), 4.0 * unit(random)};
    const double ahead = 0.05 + 0.02 * unit(random);
    const StreamTarget target{at(1.0 + ahead), from.position + from.velocity * ahead + 0.01 * unit(random),
                              from.velocity + 0.1 * unit(random)};
    StreamRules held = rules();
    held.demand = [&from](const Path& path) { return step_of_acceleration(path, from.acceleration); };
    const auto path = stream_path(from, at(1.0), target, held);
    if (!path) continue;
    ++accepted;
    EXPECT_FALSE(find_limit_violation(path.value(), held.limits)) << i;
    EXPECT_FALSE(step_of_acceleration(path.value(), from.acceleration)) << i;
    EXPECT_NEAR(path.value().sample(at(1.0)).velocity, from.velocity, 1e-12) << i;
  }
  EXPECT_GT(accepted, 1500);
}

TEST(StreamPath, WhatTheDriveNeverFollowsIsRefusedWithItsFigure) {
  StreamRules held = rules();
  held.demand = [](const Path& path) { return acceleration_violation(path.start_time(), 99.0); };
  const auto path = stream_path({0.0, 1.0, 0.0}, at(1.0), {at(1.1), 0.1, 1.0}, held);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().value, 99.0);
}

TEST(Splice, KeepsThePastAndGoesOnWithTheRest) {
  const Path path({{at(0), at(1), {{0.0, 1.0}}}, {at(1), at(2), {{1.0, 2.0}}}, {at(2), at(3), {{3.0, 3.0}}}});
  const Path rest({{at(1.5), at(4), {{2.0, 5.0}}}});
  const Path spliced = splice(path, at(0.5), at(1.5), rest);
  EXPECT_EQ(spliced.sample(at(0.75)).position, 0.75);
  EXPECT_EQ(spliced.sample(at(1.25)).position, 1.5);
  EXPECT_EQ(spliced.sample(at(1.75)).velocity, 5.0);
  EXPECT_EQ(spliced.pieces().size(), 3U);
  EXPECT_EQ(splice(path, at(1.2), at(1.5), rest).start_time(), at(1));
}

// Times that are made by adding the same numbers in another order are not the same.
TEST(Splice, TakesARestThatStartsThereButForRounding) {
  const GoalTime end = at(0.1) + at(0.2);
  ASSERT_NE(end, at(0.3));
  const Path first({{at(0.0), at(1.0), Polynomial{{0.0, 1.0}}}});
  const Path rest({{at(0.3), at(2.0), Polynomial{{5.0, 1.0}}}});
  const Path spliced = splice(first, at(0.0), end, rest);
  EXPECT_EQ(spliced.pieces()[1].start, end);
  EXPECT_EQ(spliced.sample(at(2.0)).position, 6.7);
}

// Pieces that are cut where they nearly end are left shorter than a time a second on can tell.
TEST(Shifted, LeavesOutWhatRoundingLeavesNothingOf) {
  const GoalTime sliver = at(1.0 + 3e-16);
  ASSERT_GT(sliver, at(1.0));
  const Path path({{at(0.5), at(1.0), Polynomial{{0.0, 1.0}}},
                   {at(1.0), sliver, Polynomial{{0.5, 1.0}}},
                   {sliver, at(2.0), Polynomial{{0.5, 1.0}}}});
  const Path later = shifted(path, at(7.0));
  EXPECT_EQ(later.pieces().size(), 2U);
  EXPECT_EQ(later.start_time(), at(7.5));
  EXPECT_EQ(later.sample(at(8.5)).position, 1.0);
}

TEST(Splice, RestsWhereThePathHasEndedBefore) {
  const Path path({{at(0), at(1), {{0.0, 1.0}}}});
  const Path rest({{at(5), at(6), {{1.0, 2.0}}}});
  const Path spliced = splice(path, at(0.5), at(5), rest);
  EXPECT_EQ(spliced.sample(at(3)).position, 1.0);
  EXPECT_EQ(spliced.sample(at(3)).velocity, 0.0);
  EXPECT_EQ(spliced.sample(at(5.5)).position, 2.0);
  EXPECT_EQ(splice(Path(0.7), at(4.5), at(5), rest).sample(at(4.8)).position, 0.7);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
