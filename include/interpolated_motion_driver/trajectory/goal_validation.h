#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Largest magnitude accepted for any position, velocity, acceleration or effort. Far beyond any joint, and
/// small enough that no polynomial of a path can overflow.
inline constexpr double kLargestValue = 1e9;

/// Largest tolerance (rad or m, per s, per s^2) that a goal may ask for, and the longest time (s) to settle:
/// those of the parameters `constraints/...`.
inline constexpr double kLargestTolerance = 1e6;

/// Latest time of a point. A goal is planned as a whole before it is accepted, in a time that grows with its
/// duration: an hour takes 0.4 s (EPOS2), 0.8 s (cyclic) or 2 s (SilverLode) a joint.
inline constexpr GoalTime kLatestTime{3600.0};

/// Most points of a goal: five minutes at a point a millisecond. A point takes some 100 bytes a joint until
/// the goal has been planned.
inline constexpr std::size_t kMostPoints = 300000;

/// Stands for "the goal does not name this joint".
inline constexpr std::size_t kNotNamed = static_cast<std::size_t>(-1);

/// For every joint of `joints` its column in the goal's points, or `kNotNamed`. Refused (InvalidJoints) are:
/// no names, unknown names, a name given twice, and, unless `allow_partial`, a joint left out.
Expected<std::vector<std::size_t>, Refusal> joint_columns(const std::vector<std::string>& names,
                                                          const std::vector<std::string>& joints,
                                                          bool allow_partial);

/// True for a goal without points. With joint names that `joint_columns` accepts it asks to stop; on the
/// command topic it does so with any names.
bool is_stop_request(const Goal& goal);

/// Checks a goal's form, in time linear in the points; nothing if it is well formed (a stop request is).
/// Refused are:
/// - joint names as in `joint_columns`;
/// - InvalidGoal: more than `kMostPoints`;
/// - InvalidGoal: positions missing, or positions, velocities, accelerations or efforts whose number is
///   neither 0 nor that of the joint names; numbers that are not finite or beyond `kLargestValue`; times that
///   are negative or beyond `kLatestTime`; times not strictly increasing; tolerances that are not finite;
/// - InvalidJoints: a tolerance for a joint that is not in `joints` (joint_trajectory_controller ignores it;
///   a tolerance that somebody relies on must not be lost to a typing error).
/// Velocities or accelerations in some points only are well formed, see `build_path`.
std::optional<Refusal> validate_goal(const Goal& goal, const std::vector<std::string>& joints,
                                     bool allow_partial);

/// Refused (InvalidGoal): a goal whose stamp is more than `max_ahead` after `now`. One of the past is the
/// matter of `drop_past_points`.
std::optional<Refusal> validate_stamp(const Goal& goal, GoalTime max_ahead, HostTime now);

}  // namespace interpolated_motion::trajectory
