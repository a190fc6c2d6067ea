#include "interpolated_motion_driver/motion/planning.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/bus_demands.h"
#include "interpolated_motion_driver/trajectory/goal_validation.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::motion {

namespace {

/// When a joint has come to rest for good, in the time of its path.
GoalTime rest_begin(const trajectory::Path& path) {
  const auto stands = [](const trajectory::Piece& piece) {
    const auto& c = piece.polynomial.coefficients;
    return std::all_of(c.begin() + 1, c.end(), [](double value) { return value == 0.0; });
  };
  const auto& pieces = path.pieces();
  const auto last = std::find_if_not(pieces.rbegin(), pieces.rend(), stands);
  return last == pieces.rend() ? path.start_time() : last->end;
}

}  // namespace

void Planning::run() {
  if (entry == Entry::Stop) return;
  refusal = trajectory::validate_goal(*goal, rules.joints, rules.allow_partial_joints);
  if (!refusal) refusal = entry == Entry::Join ? plan_join() : plan_from_rest();
}

std::optional<Refusal> Planning::plan_from_rest() {
  auto planned = trajectory::plan_goal(*goal, rules, present, now);
  if (!planned) return planned.error();
  plan = std::move(planned.value());
  auto refused = encode(plan.paths);
  if (refused && try_later()) return plan_from_rest();
  if (refused) return refused;
  return refuse_beyond_buses(*this, GoalTime{0.0} - plan.lead_in);
}

/// Whether a goal that the drives do not follow may be tried again with an easier way to its first point. A
/// lead-in goes before the goal's time 0: it makes no point late.
bool Planning::try_later() {
  constexpr GoalTime kFirst{0.1};
  constexpr GoalTime kMost{0.8};
  const bool can_be_easier = plan.bridge ? rules.join_late : plan.lead_in.count() > 0.0;
  if (!can_be_easier || rules.least_late >= kMost) return false;
  rules.least_late = std::max(kFirst, 2.0 * rules.least_late);
  return true;
}

std::optional<Refusal> Planning::encode(const std::vector<trajectory::Path>& course) {
  tails.clear();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto tail = axes[i].encoder->encode(course[i]);
    if (!tail) return tail.error();
    tails.push_back(std::move(tail.value()));
  }
  return std::nullopt;
}

std::optional<Refusal> Planning::plan_join() {
  auto planned = trajectory::plan_goal(*goal, rules, present, now);
  if (!planned) return planned.error();
  plan = std::move(planned.value());
  end = joining.join + plan.lead_in + plan.duration;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!plan.named[i]) end = std::max(end, rest_begin(joining.paths[i]));
  }
  paths = course_with_goal();
  if (auto refused = encode(paths)) return refused;
  return refuse_way_on_beyond_buses(*this, joining.present);
}

/// All joints rest until the drives are to leave their interpolation, in one instant. Joints that the goal
/// does not name go on with what they did.
std::vector<trajectory::Path> Planning::course_with_goal() const {
  const GoalTime leave = end + joining.linger;
  std::vector<trajectory::Path> course;
  course.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const trajectory::Path& former = joining.paths[i];
    const trajectory::Path path =
        plan.named[i] ? trajectory::splice(former, joining.kept, joining.join,
                                           trajectory::shifted(plan.paths[i], joining.join + plan.lead_in))
                      : former;
    course.push_back(trajectory::splice(path, joining.kept, leave, trajectory::Path(path.final_position())));
  }
  return course;
}

}  // namespace interpolated_motion::motion
