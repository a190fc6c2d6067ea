#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "simulation/goal_maker.h"
#include "simulation/simulation.h"

// From a goal of the script to what the driver answers.
namespace interpolated_motion::simulation {

namespace {

/// s: what a goal may take besides its duration: start lead, braking of what was under way, settling, the
/// look for it.
constexpr double kGoal = 3.0;

const char* why_bad(GoalDefect defect) {
  switch (defect) {
    case GoalDefect::BeyondLimit:
      return "ends beyond a position limit";
    case GoalDefect::StartElsewhere:
      return "begins 1 rad from where the joint is";
    case GoalDefect::EndsInMotion:
      return "ends in motion";
    case GoalDefect::NotANumber:
      return "has a position that is not a number";
    case GoalDefect::UnknownJoint:
      return "names a joint that does not exist";
    case GoalDefect::None:
      break;
  }
  return "";
}

}  // namespace

void Simulation::submit(const Event& event) {
  std::vector<double> present;
  for (const auto& joint : snapshot_.joints) present.push_back(joint.actual.position);
  HandedIn sent{event, meets_motion()};
  driver_->set_planning_time(host_duration(event.number("plan")));
  const auto goal = std::make_shared<const trajectory::Goal>(make_goal(event, ledger_.arm(), present, now_));
  handed_in_.emplace(driver_->submit_later(goal, now_), std::move(sent));
  take_answers();
}

bool Simulation::meets_motion() const {
  return ledger_.has_open_goal() || !is_at_rest(snapshot_.state) ||
         snapshot_.state == motion::GroupState::Standing;
}

void Simulation::take_answers() {
  while (const auto answered = driver_->take_goal_answer()) {
    const HandedIn handed_in = std::move(handed_in_.at(answered->ticket));
    handed_in_.erase(answered->ticket);
    const auto& answer = answered->answer;
    if (!answer) {
      if (!answered->goal->points.empty()) ++outcome_.goals_refused;
      say("refused: " + answer.error().text);
    } else if (answered->goal->points.empty()) {
      accept_stop(answer.value().id);
    } else {
      say(fmt::format("goal {} accepted, {:.3f} s", answer.value().id, answer.value().duration.count()));
      accept(handed_in, *answered->goal, answer.value());
    }
  }
}

void Simulation::accept(const HandedIn& handed_in, const trajectory::Goal& goal,
                        const motion::GoalAcceptance& acceptance) {
  ++outcome_.goals_accepted;
  GoalEntry entry;
  entry.met_motion = handed_in.met_motion || meets_motion();
  // Points in the past are left out, as is one at the time 0 of a goal that joins a motion.
  const bool leaves_out_start = entry.met_motion || (goal.start && *goal.start < now_);
  const GoalDefect defect = defect_of(handed_in.event);
  if (defect != GoalDefect::None && !(defect == GoalDefect::StartElsewhere && leaves_out_start))
    for (const auto& invariant : invariants_) invariant->wrongly_accepted(why_bad(defect));
  ledger_.interrupt("goal", now_);
  const double wait = goal.start ? std::max(0.0, seconds(*goal.start - now_)) : 0.0;
  const double planning = handed_in.event.number("plan");
  entry.accepted = now_;
  entry.due =
      now_ + host_duration(wait + acceptance.duration.count() + planning + ledger_.arm().settle_time + kGoal);
  for (std::size_t j = 0; j < goal.joint_names.size(); ++j)
    entry.target.emplace_back(j, goal.points.back().positions[j]);
  ledger_.accept(acceptance.id, std::move(entry));
}

void Simulation::submit_stop() {
  const auto stop = std::make_shared<const trajectory::Goal>(make_stop(ledger_.arm()));
  handed_in_.emplace(driver_->submit_later(stop, now_), HandedIn{});
  take_answers();
}

void Simulation::accept_stop(motion::GoalId id) {
  GoalEntry entry;
  entry.accepted = now_;
  entry.is_stop = true;
  entry.due = now_ + host_duration(kGoal);
  ledger_.interrupt("stop", now_);
  ledger_.accept(id, std::move(entry));
}

}  // namespace interpolated_motion::simulation
