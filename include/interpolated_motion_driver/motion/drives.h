#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/motion/active_goal.h"
#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/motion/course.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/motion/timed_paths.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The drives of a group as one: its axes, the state they are in together, and the course that they play.
/// What they are to do is up to others.
class Drives {
 public:
  /// Axes and signals must outlive it.
  Drives(Axes axes, Signals signals) : axes_(std::move(axes)), signals_(std::move(signals)) {}

  const Axes& axes() const { return axes_; }
  const Signals& signals() const { return signals_; }

  GroupState state() const { return state_; }
  void enter(GroupState state);
  /// Idle, or Disabled where not all drives are on.
  void enter_rest_state(HostTime now);
  /// Counts what was entered.
  std::uint64_t states() const { return states_; }

  /// What the drives are playing or have played last.
  const Course& course() const { return course_; }
  /// The drives play the course, or have just done so.
  bool plays_course() const;
  /// That, or they are being loaded for it.
  bool in_motion() const;
  /// From when on the course can be changed, in its goal time; nothing where it cannot.
  std::optional<GoalTime> changeable_from() const;
  /// The drives have all of their motion, and it ends on the course.
  bool ends_by_itself() const;
  /// Of all axes, from rest.
  void load(std::vector<axis::TailPtr> tails, HostTime now);
  /// Another motion begins: `motion` for the report.
  void begin(TimedPaths course, const LastMotion& motion, HostTime now);
  /// The same motion goes on otherwise behind what is committed.
  void follow(TimedPaths course, std::vector<axis::TailPtr> tails, HostTime now);
  /// The course stays as it is for `allowance` longer than it has to.
  void hold(GoalTime allowance);
  /// All brake by themselves.
  void stop(HostTime now);

  /// What is asked of a joint at `when`: by the course; where it brakes by itself, or nothing holds it, what
  /// it does.
  trajectory::State desired(std::size_t joint, HostTime when) const;
  /// That of all joints. False, and `out` as it was, for a time before the begin of what is in force.
  bool query(HostTime time, std::vector<trajectory::State>& out) const;

  /// The motion begun last, and from now on for a new one that has joined it.
  const std::optional<LastMotion>& last() const { return last_; }
  void set_last(const LastMotion& motion) { last_ = motion; }

 private:
  Axes axes_;
  Signals signals_;
  GroupState state_ = GroupState::Starting;
  std::uint64_t states_ = 0;
  Course course_;
  HostTime in_force_since_ = kNever;  ///< start of the trajectory (or rest) that query() answers for
  std::optional<LastMotion> last_;
};

}  // namespace interpolated_motion::motion
