#include "interpolated_motion_driver/trajectory/stop_path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

namespace interpolated_motion::trajectory {

namespace {

void require_deceleration(const JointLimits& limits) {
  if (limits.max_acceleration > 0.0) return;
  throw std::invalid_argument(
      fmt::format("stop path: max_acceleration is {}, but must be greater than 0", limits.max_acceleration));
}

}  // namespace

Path stop_path(const State& from, GoalTime start, const JointLimits& limits) {
  require_deceleration(limits);
  const double v = from.velocity;
  if (v == 0.0) return Path(from.position);
  const double shortest = kShortestMotion.count();
  const GoalTime end = start + GoalTime(std::max(1.5 * std::abs(v) / limits.max_acceleration, shortest));
  const double duration = (end - start).count();
  const double c3 = -v / (duration * duration);
  const double c4 = 0.5 * v / (duration * duration * duration);
  return Path({Piece{start, end, Polynomial{{from.position, v, 0.0, c3, c4, 0.0}}}});
}

Path shortest_stop_path(const State& from, GoalTime start, const JointLimits& limits) {
  require_deceleration(limits);
  const double v = from.velocity;
  const GoalTime end = start + GoalTime(std::abs(v) / limits.max_acceleration);
  if (!(end > start)) return Path(from.position);
  const double duration = (end - start).count();
  return Path({Piece{start, end, Polynomial{{from.position, v, -v / (2.0 * duration), 0.0, 0.0, 0.0}}}});
}

}  // namespace interpolated_motion::trajectory
