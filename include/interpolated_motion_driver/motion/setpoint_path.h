#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The paths of a group made of a stream of setpoints while it comes in: one more piece per setpoint, and
/// always a stop and a rest behind the newest. Goal time 0 is the begin of the stream.
class SetpointPath {
 public:
  /// No stream yet: begin() one.
  SetpointPath(trajectory::GoalRules rules, const StreamParameters& parameters);

  /// A new stream at `now`, from rest at `positions`, of drives that must know what to do `lead` ahead.
  void begin(const std::vector<double>& positions, GoalTime lead, HostTime now);

  /// Why a setpoint that has come at `now` is none of this stream: another sender, wrong joints or sizes,
  /// numbers that are not finite, one not newer than the last, too old, too far ahead.
  std::optional<Refusal> check(const Setpoint& setpoint, HostTime now) const;
  /// The paths with one more setpoint; what they say up to `committed` is as it was. Refused when it cannot
  /// be reached within the limits. The first one may be reached as much later as the drives have taken to
  /// begin.
  Expected<std::vector<trajectory::Path>, Refusal> way_to(const Setpoint& setpoint, HostTime committed) const;
  /// `setpoint` is the newest of the stream; what is to become of it, follow() or pass_over() tell.
  void take(const Setpoint& setpoint);
  /// Goes on along the paths that way_to() has found for `setpoint`.
  void follow(const Setpoint& setpoint, std::vector<trajectory::Path> paths);
  /// Does not aim at `setpoint`, since a newer one has come before the drives have begun.
  void pass_over(const Setpoint& setpoint);

  /// One path per joint, in the order of the rules; none before the first stream.
  const std::vector<trajectory::Path>& paths() const { return paths_; }
  /// Counts the changes of paths().
  std::uint64_t revision() const { return revision_; }

 private:
  /// What is known of one joint's stream: the last setpoints, the newest first.
  struct Knot {
    double time = 0.0;      ///< s
    double position = 0.0;  ///< rad
  };
  using Knots = std::array<Knot, 3>;

  std::optional<Refusal> check_joints(const Setpoint& setpoint) const;
  std::optional<Refusal> check_time(const Setpoint& setpoint, HostTime now) const;
  trajectory::StreamTarget target(const Setpoint& setpoint, std::size_t joint, std::size_t column) const;
  double estimated_velocity(std::size_t joint, double time, double position) const;
  GoalTime goal_time(HostTime when) const { return GoalTime{seconds(when - origin_)}; }

  trajectory::GoalRules rules_;
  StreamParameters parameters_;
  std::uint64_t revision_ = 0;
  GoalTime delay_{0.0};
  HostTime origin_{};
  bool joined_ = false;  ///< the paths have met a setpoint
  std::string source_;
  std::optional<HostTime> newest_;
  std::vector<trajectory::Path> paths_;
  std::vector<Knots> knots_;
  std::size_t known_ = 0;  ///< setpoints in `knots_`
};

}  // namespace interpolated_motion::motion
