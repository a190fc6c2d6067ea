#include "interpolated_motion_driver/trajectory/rejoin.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/remainder.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::trajectory {

namespace {

constexpr double kNextBridge = 1.5;

JointLimits widened(const JointLimits& limits, const State& from, double margin) {
  JointLimits wide = limits;
  wide.max_velocity = std::max(margin * wide.max_velocity, std::abs(from.velocity));
  wide.max_acceleration *= margin;
  wide.min_position = std::min(wide.min_position, from.position);
  wide.max_position = std::max(wide.max_position, from.position);
  return wide;
}

/// At rest behind the path's end, whatever its last piece leaves of acceleration.
State state_on(const Path& path, GoalTime time) {
  if (time >= path.end_time()) return {path.final_position(), 0.0, 0.0};
  return path.sample(time);
}

Path bridged(const Piece& bridge, const Path& path) {
  std::vector<Piece> pieces{bridge};
  const auto add = [&pieces](const Path& rest) {
    pieces.insert(pieces.end(), rest.pieces().begin(), rest.pieces().end());
  };
  if (bridge.end < path.start_time()) {
    pieces.push_back({bridge.end, path.start_time(), {{path.sample(path.start_time()).position}}});
    add(path);
  } else {
    add(shifted(remainder(path, bridge.end, 1.0), bridge.end));
  }
  return Path(std::move(pieces));
}

}  // namespace

std::optional<Path> rejoin(const Path& path, const State& from, GoalTime start, const JointLimits& limits,
                           double margin, GoalTime shortest, GoalTime longest) {
  const JointLimits wide = widened(limits, from, margin);
  for (GoalTime length = shortest; length <= longest; length *= kNextBridge) {
    const GoalTime end = start + length;
    const Piece bridge{start, end, quintic_hermite(from, state_on(path, end), (end - start).count())};
    if (!find_limit_violation(Path({bridge}), wide)) return bridged(bridge, path);
  }
  return std::nullopt;
}

}  // namespace interpolated_motion::trajectory
