#include "simulation/invariants/on_course.h"

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

/// Counts: a drive that has braked by itself stands between two counts and can tell whole ones only, from
/// which the next path starts.
constexpr double kSlack = 0.5;

/// A path is loaded into the drives, or played.
bool is_under_way(motion::GroupState state) {
  using motion::GroupState;
  return state == GroupState::Preparing || state == GroupState::Moving || state == GroupState::Settling ||
         state == GroupState::Streaming || state == GroupState::Standing;
}

}  // namespace

void OnCourse::goal_ended(const GoalEntry& goal) {
  if (goal.result->outcome != motion::GoalOutcome::Succeeded || goal.is_stop) return;
  ended_ = goal.result->id;
  met_motion_ = goal.met_motion;
}

// Of goals that have taken over in motion the driver tells what is missing since that motion began.
std::uint32_t OnCourse::allowed_underruns(const Joint& joint) const {
  return joint.kind == "cyclic" ? ledger().syncs_in_absences(rested_, joint.target_period) : 0U;
}

void OnCourse::look(const Look& look) {
  judge(look);
  if (look.is_host_there && !is_under_way(ledger().state())) rested_ = look.now;
}

void OnCourse::judge(const Look& look) {
  if (ledger().is_disturbed() || ended_ == 0 || look.report == nullptr || !look.report->valid ||
      look.report->goal != ended_)
    return;
  for (std::size_t i = 0; i < look.report->joints.size(); ++i) {
    const motion::JointReport& report = look.report->joints[i];
    const Joint& joint = arm().joints[i];
    const double bound = met_motion_ ? joint.joining_bound : joint.deviation_bound;
    if (report.worst_deviation > bound + kSlack)
      fail(fmt::format("{} was {:.2f} counts off the path of goal {}, allowed {}", joint.label(),
                       report.worst_deviation, ended_, bound));
    const std::uint32_t underruns = allowed_underruns(joint);
    if (report.underruns > underruns)
      fail(fmt::format("{}: {} underruns in goal {}, allowed {}", joint.label(), report.underruns, ended_,
                       underruns));
  }
  ended_ = 0;  // what its drives miss later, standing, is nothing of the goal
}

}  // namespace interpolated_motion::simulation
