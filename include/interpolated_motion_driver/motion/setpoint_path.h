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

/// The way of a group along a stream of setpoints while it comes in: one more piece per setpoint, and always
/// a stop and a rest behind the newest.
class SetpointPath {
 public:
  /// No stream yet: begin() one.
  SetpointPath(trajectory::GoalRules rules, const StreamParameters& parameters);

  /// Of the drive of each joint; empty: none has any.
  using DemandChecks = std::vector<trajectory::DemandCheck>;

  /// A new stream on a course whose goal time 0 is at `origin`, of drives that must know what to do `lead`
  /// ahead.
  void begin(HostTime origin, GoalTime lead);

  /// Why a setpoint that has come at `now` is none of this stream: another sender, wrong joints or sizes,
  /// numbers that are not finite, one not newer than the last, too old, too far ahead.
  std::optional<Refusal> check(const Setpoint& setpoint, HostTime now) const;
  /// The way on of all joints from `start`, goal time of the course, where they are in the states `from`, to
  /// one more setpoint, a stop and a rest. Refused when it cannot be reached within the limits, at most
  /// `catch_up` later than it is due, or than `start`.
  Expected<std::vector<trajectory::Path>, Refusal> way_to(const Setpoint& setpoint, GoalTime start,
                                                          const std::vector<trajectory::State>& from,
                                                          const DemandChecks& demands = {}) const;
  /// `setpoint` is the newest of the stream; note() it when that is decided.
  void take(const Setpoint& setpoint);
  /// `setpoint` has its place in the stream, by which the velocity of later ones is known: whether the arm
  /// goes the way that way_to() has found for it, or a newer one has come before the drives have begun.
  void note(const Setpoint& setpoint);
  /// As way_to(), of host time.
  GoalTime goal_time(HostTime when) const { return GoalTime{seconds(when - origin_)}; }

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

  trajectory::GoalRules rules_;
  StreamParameters parameters_;
  GoalTime delay_{0.0};
  HostTime origin_{};
  std::string source_;
  std::optional<HostTime> newest_;
  std::vector<Knots> knots_;
  std::size_t known_ = 0;  ///< setpoints in `knots_`
};

}  // namespace interpolated_motion::motion
