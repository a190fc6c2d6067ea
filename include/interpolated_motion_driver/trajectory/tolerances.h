#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Largest error allowed in each quantity (rad or m, per s, per s^2); 0 does not check it.
struct StateTolerance {
  double position = 0.0;      ///< rad or m
  double velocity = 0.0;      ///< per s
  double acceleration = 0.0;  ///< per s^2
};

/// Tolerances of a goal while it runs: one entry per joint, in the order of the configuration.
struct Tolerances {
  std::vector<StateTolerance> path;  ///< on the way
  std::vector<StateTolerance> goal;  ///< at the end
  GoalTime goal_time{0.0};           ///< how long after its end a goal may take to get within `goal`
};

/// Tolerances of the parameters `constraints/<joint>/trajectory` and `/goal` (one entry per joint),
/// `constraints/stopped_velocity_tolerance` (one entry per joint as well) and `constraints/goal_time`. Throws
/// std::invalid_argument, naming the parameter, if the vectors differ in length or a value is negative or not
/// finite.
Tolerances default_tolerances(const std::vector<double>& trajectory, const std::vector<double>& goal,
                              const std::vector<double>& stopped_velocity, double goal_time);

/// `defaults` overridden by what `goal` says: a positive value sets a tolerance, 0 keeps it, a negative one
/// erases it (as control_msgs/FollowJointTrajectory defines). Of several entries for one joint each is
/// applied in turn; those of joints not in `joints` are passed over (`validate_goal` refuses them).
/// `defaults` has one entry per joint.
Tolerances merge_tolerances(const Tolerances& defaults, const std::vector<std::string>& joints,
                            const Goal& goal);

/// The first joint out of tolerance.
struct ToleranceViolation {
  std::size_t joint = 0;                   ///< index
  Quantity quantity = Quantity::Position;  ///< decides the unit of `error` and `tolerance`
  double error = 0.0;                      ///< desired - actual in `quantity`
  double tolerance = 0.0;                  ///< of `quantity`
  double position_error = 0.0;             ///< desired - actual position, whatever `quantity` is
};

/// Compares desired with actual states; all vectors have one entry per joint. Nothing if all are within. No
/// allocation.
std::optional<ToleranceViolation> find_tolerance_violation(const std::vector<StateTolerance>& tolerances,
                                                           const std::vector<State>& desired,
                                                           const std::vector<State>& actual);

/// PathToleranceViolated, "<joint> path error <position error, %f>" and a sentence of our own. `unit`: of the
/// joint.
Refusal path_tolerance_violated(const std::string& joint, JointUnit unit,
                                const ToleranceViolation& violation);

/// GoalToleranceViolated, "<joint> goal error <position error, %f>" and a sentence of our own.
Refusal goal_tolerance_violated(const std::string& joint, JointUnit unit,
                                const ToleranceViolation& violation);

}  // namespace interpolated_motion::trajectory
