#include "interpolated_motion_driver/motion/planning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/motion/bus_demands.h"
#include "interpolated_motion_driver/trajectory/goal_validation.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"
#include "interpolated_motion_driver/trajectory/retime.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::motion {

namespace {

/// Of a path as a whole.
constexpr GoalTime kFromItsBegin{-std::numeric_limits<double>::infinity()};
/// Drives that do not follow a change of speed are asked again with twice the ramp, until it is so long.
constexpr GoalTime kLongestRamp{5.0};
/// A multiple of all drives' sampling periods.
constexpr GoalTime kSamples{0.1};
constexpr double kRounding = 1e-9;
/// Part of a joint's limits at which a paused joint is brought back to its path.
constexpr double kReturnShare = 0.5;

Refusal too_fast(const trajectory::GoalRules& rules, const trajectory::SpeedViolation& violation) {
  const std::size_t joint = violation.joint;
  Refusal refusal =
      trajectory::limit_refusal(rules.joints[joint], rules.limits[joint].unit, violation.violation);
  refusal.text = "The speed cannot be changed here. " + refusal.text;
  return refusal;
}

}  // namespace

void Planning::run() {
  if (entry == Entry::Stop) return;
  if (goal) refusal = trajectory::validate_goal(*goal, rules.joints, rules.allow_partial_joints);
  if (refusal) return;
  if (entry == Entry::Join) {
    refusal = plan_join();
  } else {
    refusal = goal ? plan_from_rest() : plan_resume();
  }
}

// From rest.

std::optional<Refusal> Planning::plan_from_rest() {
  auto planned = trajectory::plan_goal(*goal, rules, present, now);
  if (!planned) return planned.error();
  plan = std::move(planned.value());
  end = plan.duration;
  course = at_own_speed(plan.paths);
  if (!is_paused() && speed.rate != 1.0) {
    const double rate =
        std::min(speed.rate, trajectory::highest_rate(plan.paths, kFromItsBegin, rules.limits));
    course.law = trajectory::TimeLaw(rate, -plan.lead_in, -plan.lead_in);
    course.executed = executed();
  }
  auto refused = encode();
  if (refused && try_later()) return plan_from_rest();
  if (!refused) refused = refuse_beyond_buses(*this, GoalTime{0.0} - plan.lead_in);
  if (is_paused()) {
    tails.clear();
    course.law = trajectory::TimeLaw(0.0, -plan.lead_in, -plan.lead_in);
  }
  return refused;
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

/// Back to the path, where a joint is not quite on it any more, and from standing still to the speed.
std::optional<Refusal> Planning::plan_resume() {
  end = motion.end;
  course.nominal = motion.nominal;
  course.law = trajectory::TimeLaw(0.0, GoalTime{0.0}, motion.reached);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double position = course.nominal[i].sample(motion.reached).position;
    const double distance = position - present[i].position;
    if (std::abs(distance) > rules.start_tolerance[i]) {
      const char* unit = trajectory::symbol(rules.limits[i].unit);
      return Refusal{
          GoalError::InvalidGoal,
          fmt::format("{0}: it was moved while the goal was paused: it is at {1:.6g} {3}, and was paused at "
                      "{2:.6g} {3}. Send the goal again.",
                      rules.joints[i], present[i].position, position, unit)};
    }
    if (std::abs(distance) <= rules.lead_in_threshold[i]) continue;
    const GoalTime way = trajectory::rest_to_rest_duration(distance, rules.limits[i], kReturnShare);
    plan.lead_in = std::max({plan.lead_in, way, trajectory::kShortestMotion});
  }
  plan.lead_in = GoalTime{1e-3 * std::ceil(1e3 * plan.lead_in.count())};  // samples of the drives
  if (auto refused = encode_at_speed(wait_for_samples())) return refused;
  return refuse_beyond_buses(*this, GoalTime{0.0} - plan.lead_in);
}

/// How long the joints stand still on, so that at the full speed the drives come to the path at the instants
/// of their samples as they would have without the pause: what was certified then holds again.
GoalTime Planning::wait_for_samples() {
  if (speed.rate != 1.0) return GoalTime{0.0};
  const auto law = trajectory::speed_changed(course.law, GoalTime{0.0}, speed, course.nominal, rules.limits);
  if (!law) return GoalTime{0.0};
  const GoalTime steady = law.value().steady_from();
  const GoalTime later = steady + plan.lead_in - (law.value().at(steady).nominal - motion.begin);
  return kSamples * std::ceil(later / kSamples - kRounding) - later;
}

// In motion.

std::optional<Refusal> Planning::plan_join() {
  course = joining.course;
  end = motion.end;
  if (goal) {
    if (auto refused = plan_goal_to_join()) return refused;
  }
  const bool at_speed = goal && course.law.final_rate() == speed.rate && speed.rate <= 1.0;
  if (at_speed) course.executed = executed();
  if (auto refused = at_speed ? encode() : encode_at_speed(joining.join)) return refused;
  course.law.forget(joining.kept);
  return refuse_way_on_beyond_buses(*this, joining.present);
}

std::optional<Refusal> Planning::plan_goal_to_join() {
  auto planned = trajectory::plan_goal(*goal, rules, present, now);
  if (!planned) return planned.error();
  plan = std::move(planned.value());
  const GoalTime join = course.law.at(joining.join).nominal;
  end = join + plan.lead_in + plan.duration;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!plan.named[i]) end = std::max(end, trajectory::rest_begin(course.nominal[i]));
  }
  course.nominal = nominal_with_goal(join);
  return std::nullopt;
}

/// Joints that the goal does not name go on with what they did.
std::vector<trajectory::Path> Planning::nominal_with_goal(GoalTime join) const {
  const GoalTime kept = course.law.at(joining.kept).nominal;
  std::vector<trajectory::Path> nominal = course.nominal;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (plan.named[i])
      nominal[i] =
          trajectory::splice(nominal[i], kept, join, trajectory::shifted(plan.paths[i], join + plan.lead_in));
  }
  return nominal;
}

// What the drives get.

/// At the speed from goal time `from` on, in a ramp that the drives follow.
std::optional<Refusal> Planning::encode_at_speed(GoalTime from) {
  const trajectory::TimeLaw before = course.law;
  for (;; speed.ramp *= 2.0) {
    auto law = trajectory::speed_changed(before, from, speed, course.nominal, rules.limits);
    if (!law) return too_fast(rules, law.error());
    course.law = std::move(law.value());
    course.executed = executed();
    auto refused = encode();
    if (!refused || speed.ramp > kLongestRamp) return refused;
  }
}

std::optional<Refusal> Planning::encode() {
  tails.clear();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto tail = axes[i].encoder->encode(course.executed[i]);
    if (!tail) return tail.error();
    tails.push_back(std::move(tail.value()));
  }
  return std::nullopt;
}

std::vector<trajectory::Path> Planning::executed() const {
  std::vector<trajectory::Path> paths;
  paths.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    paths.push_back(entry == Entry::Join ? executed_behind_join(i) : executed_from_rest(i));
  return paths;
}

trajectory::Path Planning::executed_from_rest(std::size_t joint) const {
  const trajectory::Path& nominal = course.nominal[joint];
  if (goal) return trajectory::retimed(nominal, course.law, kFromItsBegin);
  trajectory::Path path = trajectory::retimed(nominal, course.law, GoalTime{0.0});
  if (plan.lead_in == GoalTime{0.0}) return path;
  const double begin = nominal.sample(motion.reached).position;
  const double from = std::abs(begin - present[joint].position) > rules.lead_in_threshold[joint]
                          ? present[joint].position
                          : begin;
  const trajectory::Piece way = trajectory::rest_to_rest(from, begin, -plan.lead_in, plan.lead_in);
  return trajectory::splice(trajectory::Path({way}), way.start, GoalTime{0.0}, path);
}

/// All joints rest until the drives are to leave their interpolation, in one instant.
trajectory::Path Planning::executed_behind_join(std::size_t joint) const {
  const trajectory::Path& nominal = course.nominal[joint];
  const GoalTime leave = course.law.when(end).value_or(course.law.steady_from()) + joining.linger;
  const trajectory::Path path =
      course.law.is_identity()
          ? nominal
          : trajectory::splice(joining.course.executed[joint], joining.kept, joining.join,
                               trajectory::retimed(nominal, course.law, joining.join));
  return trajectory::splice(path, joining.kept, leave, trajectory::Path(path.final_position()));
}

}  // namespace interpolated_motion::motion
