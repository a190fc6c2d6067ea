#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Part of the limits that a lead-in uses: it should look like the careful approach it is.
inline constexpr double kLeadInPart = 0.5;

/// A distance (rad) this much longer than half a turn counts as half a turn: two angles given with three
/// decimals are up to 1e-3 rad off, and the joint that rests at one of them is off by some counts.
inline constexpr double kHalfTurnTolerance = 2e-3;

/// The part of a goal that a path is made of.
struct PointSelection {
  std::vector<std::size_t> columns;  ///< of every joint in the points, or `kNotNamed`
  std::vector<std::size_t> points;   ///< indices of the points used, at least one
  GoalTime skipped{0.0};             ///< time of the plan = time of the goal - `skipped`
  GoalTime late{0.0};                ///< by which the points are met later than the goal asks for
};

/// How a goal gets going from the present states.
struct GoalStart {
  bool bridge = false;    ///< the path begins at the present positions, at 0; else at the first point
  GoalTime lead_in{0.0};  ///< length of the move to the first point before time 0
  std::vector<double>
      shift;            ///< to be added to all positions of a joint: a multiple of 2 pi, 0 unless continuous
  std::string warning;  ///< if the first point cannot be met as it is
};

/// Decides how the goal starts, by the rules of `plan_goal`. Where the first point cannot be met because it
/// moves, or the joints do, or did when the goal was sent, it is taken out of `selection`. Refused
/// (InvalidGoal): a first point at 0 farther from the present position than the joint's start tolerance; one
/// that is the only point, in the words of joint_trajectory_controller, which drops it.
Expected<GoalStart, Refusal> plan_start(const Goal& goal, const GoalRules& rules,
                                        const std::vector<State>& present, PointSelection& selection);

}  // namespace interpolated_motion::trajectory
