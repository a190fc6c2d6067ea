#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/motion/active_goal.h"
#include "interpolated_motion_driver/motion/drives.h"
#include "interpolated_motion_driver/motion/group_parameters.h"
#include "interpolated_motion_driver/motion/outcomes.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/motion/speed_control.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The goal that the drives execute: loaded into all FIFOs, common start, supervised, settled, ended.
///
/// Common start: axes that begin at the start signal of their bus all get it at once. Where others begin at
/// an instant they are told beforehand, the former rest for a while after their signal, and the latter are
/// told when that will be over.
class Execution {
 public:
  /// All must outlive it.
  Execution(const GroupParameters& parameters, Drives& drives, const SpeedControl& speed, Outcomes& outcomes);

  /// The goal under way, also one that is paused and stands.
  const std::optional<ActiveGoal>& active() const { return active_; }
  /// From when on the motion can be changed, in goal time of the course; nothing where it cannot.
  std::optional<GoalTime> changeable_from() const;

  // Each of these takes what has been planned; what was active before has been ended.

  /// A goal from rest. While it is paused it waits; go_on() then begins it.
  void begin(GoalId id, Planning& planning, HostTime now);
  /// A goal behind what is committed.
  void join(GoalId id, Planning& planning, HostTime now);
  /// The active goal at another speed, from rest or in motion.
  void go_on(Planning& planning, HostTime now);
  /// No other speed is possible: it stays.
  void stay(const Planning& planning) { active_->speeds = planning.premises.speeds; }
  /// A word for the success of the active goal.
  void remark(std::string text) { active_->remark = std::move(text); }

  /// What is due while it is being loaded, moves and settles. `is_replaced`: another goal waits for its end.
  void poll(bool is_replaced, HostTime now);
  /// Only while it is being loaded, moves or settles.
  HostTime next_deadline() const;

  /// All drives brake by themselves, and the active goal ends when they stand.
  void stop(const Ending& ending, HostTime now);
  /// The course ends before the goal does: the goal ends so when the drives stand there.
  void end_on_path(const Ending& ending) { active_->ending = ending; }
  void abort_with_fault_of(const axis::Axis& axis, HostTime now);
  /// The drives stand after a stop.
  void end_stopped();
  /// At once. Without effect where none is active.
  void finish(const Ending& ending);

  /// What is published of it.
  void fill(HostTime now, Snapshot& out) const;

 private:
  void poll_preparing(HostTime now);
  void poll_moving(bool is_replaced, HostTime now);
  void poll_settling(bool is_replaced, HostTime now);
  void load(Planning& planning, HostTime now);
  void start_motion(HostTime now);
  void set_common_begin(HostTime now);
  void rest_on_path(bool is_replaced, HostTime now);
  bool stops_on_way() const;
  GoalTime nominal_time(HostTime now) const;
  void sample_feedback();
  std::optional<Refusal> find_violation(bool at_goal);

  /// Scratch, at each axis' latest feedback.
  struct Tracking {
    std::vector<trajectory::State> desired;
    std::vector<trajectory::State> actual;
  };

  const GroupParameters& parameters_;
  Drives& drives_;
  const SpeedControl& speed_;
  Outcomes& outcomes_;
  std::optional<ActiveGoal> active_;
  std::optional<Ending> ending_;
  Tracking tracking_;
};

}  // namespace interpolated_motion::motion
