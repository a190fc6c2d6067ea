#include "interpolated_motion_driver/hardware/group_parameters.h"

#include <cmath>
#include <vector>

namespace interpolated_motion::hardware {

namespace {

/// A position nearer to a goal's first point than half a count is at that point, for a drive that knows whole
/// counts.
constexpr double kLeadInCounts = 0.5;

}  // namespace

motion::GroupParameters group_parameters(const Configuration& configuration) {
  motion::GroupParameters parameters;
  std::vector<double> path;
  std::vector<double> goal;
  std::vector<double> stopped;
  for (const DriveConfiguration& drive : configuration.drives) {
    const ConstraintConfiguration::Joint& joint = configuration.constraints.joints.at(drive.joint);
    parameters.rules.joints.push_back(drive.joint);
    parameters.rules.limits.push_back(drive.limits);
    parameters.rules.start_tolerance.push_back(joint.start);
    parameters.rules.lead_in_threshold.push_back(kLeadInCounts /
                                                 std::abs(drive.transmission.counts_per_radian()));
    path.push_back(joint.trajectory);
    goal.push_back(joint.goal);
    stopped.push_back(joint.stopped_velocity);
  }
  parameters.rules.allow_partial_joints = configuration.allow_partial_joints_goal;
  parameters.rules.join_late = configuration.join_late;
  parameters.rules.max_start_ahead = GoalTime{configuration.max_start_ahead};
  parameters.tolerances =
      trajectory::default_tolerances(path, goal, stopped, configuration.constraints.goal_time);
  parameters.settle_timeout = host_duration(configuration.settle_timeout);
  parameters.stream = configuration.setpoints;
  parameters.speed_ramp = GoalTime{configuration.speed_ramp};
  parameters.stop_duration = GoalTime{configuration.stop_trajectory_duration};
  parameters.enable_on_start = configuration.enable_on_start;
  return parameters;
}

}  // namespace interpolated_motion::hardware
