#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The paths of a group made of a stream of setpoints while it comes in: one more piece per setpoint, and
/// always a stop behind the newest. Goal time 0 is the begin of the stream.
class SetpointPath {
 public:
  SetpointPath(trajectory::GoalRules rules, const StreamParameters& parameters);

  /// A new stream at `now`, from rest at `positions`.
  void begin(const std::vector<double>& positions, HostTime now);

  /// Takes a setpoint that has come at `now`; what the paths say up to `committed` can no longer be changed.
  /// Refused, and the paths unchanged: another sender, wrong joints or sizes, numbers that are not finite,
  /// one not newer than the last, too old, too far ahead, or not to be reached within the limits.
  std::optional<Refusal> add(const Setpoint& setpoint, HostTime committed, HostTime now);

  const std::vector<trajectory::Path>& paths() const { return paths_; }
  HostTime origin() const { return origin_; }  ///< host time of goal time 0

 private:
  /// What is known of one joint's stream: the last setpoints, the newest first.
  struct Knot {
    double time = 0.0;  ///< s
    double position = 0.0;
  };
  using Knots = std::array<Knot, 3>;

  std::optional<Refusal> check(const Setpoint& setpoint, HostTime now) const;
  std::optional<Refusal> check_joints(const Setpoint& setpoint) const;
  std::optional<Refusal> check_time(const Setpoint& setpoint, HostTime now) const;
  trajectory::StreamTarget target(const Setpoint& setpoint, std::size_t joint, std::size_t column) const;
  double estimated_velocity(std::size_t joint, double time, double position) const;
  GoalTime goal_time(HostTime when) const { return GoalTime{seconds(when - origin_)}; }

  trajectory::GoalRules rules_;
  StreamParameters parameters_;
  HostTime origin_{};
  std::string source_;
  std::optional<HostTime> newest_;
  std::vector<trajectory::Path> paths_;
  std::vector<Knots> knots_;
  std::size_t known_ = 0;  ///< setpoints in `knots_`
};

}  // namespace interpolated_motion::motion
