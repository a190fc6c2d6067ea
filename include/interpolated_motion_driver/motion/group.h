#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/motion/course.h"
#include "interpolated_motion_driver/motion/drives.h"
#include "interpolated_motion_driver/motion/goals.h"
#include "interpolated_motion_driver/motion/group_parameters.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/requests.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/motion/speed_control.h"
#include "interpolated_motion_driver/motion/stream.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A group of axes that move together, on any mix of buses and kinds of drives. From rest a goal goes
/// through: checked and encoded whole for every axis, loaded into all FIFOs, common start, supervised,
/// settled. Whatever goes wrong on the way brings all axes to rest, and nothing moves again without a new
/// goal.
///
/// A goal that comes while the drives are under way joins: behind what is committed the course of all joints
/// is another one, without standing still. All axes take it at once, or none does, and the former motion
/// goes on.
class Group {
 public:
  /// The axes and start signals must outlive the group; axes in the order of `parameters.rules.joints`.
  Group(GroupParameters parameters, std::vector<axis::Axis*> axes, std::vector<axis::StartSignal*> signals,
        HostTime now);

  /// Polls all axes, then does what the state demands. `now` never runs backwards.
  void poll(HostTime now);
  /// When poll() must be called next; kNever when only something received can change anything.
  HostTime next_deadline() const;
  /// As of the latest poll() or call that changes it.
  GroupState state() const { return drives_.state(); }
  /// Why the group is in Fault; empty otherwise.
  const std::string& fault() const { return fault_; }

  /// Takes a goal, or says why not; then what is under way goes on. One that is under way ends as Preempted.
  /// Planned on the spot: begin(), Planning::run() and end() in one.
  Expected<GoalAcceptance, Refusal> submit(const trajectory::Goal& goal, HostTime now);
  /// Begins to take a goal, or says why not. Planning runs wherever it may, one at a time. `allowance`: how
  /// long it may take; where the goal joins, the drives commit to so much more of their present motion.
  Expected<PlanningPtr, Refusal> begin(GoalPtr goal, GoalTime allowance, HostTime now);
  /// The goal is taken as it has been planned, or refused. Nothing: what the drives do has changed meanwhile,
  /// or planning took longer than allowed; then renew().
  std::optional<Expected<GoalAcceptance, Refusal>> end(Planning& planning, HostTime now);
  /// Begins once more, for what the drives do now.
  Expected<PlanningPtr, Refusal> renew(const Planning& stale, GoalTime allowance, HostTime now);
  /// Planning that was begun is of no use any more, and goes without end().
  void drop_planning() { goals_.drop_planning(); }
  /// What planning that is begun now stands on. `orders` counts what stops the group, and with it whatever
  /// has been sent before.
  Planning::Premises premises() const { return goals_.premises(); }
  /// What the group itself has to plan, to be given to end_own(): a goal that has waited for rest, or another
  /// speed. Null while there is nothing. `allowance` as for begin().
  PlanningPtr take_planning(GoalTime allowance, HostTime now) { return goals_.take_planning(allowance, now); }
  /// Without it there is nothing to take.
  bool may_plan() const { return goals_.may_plan(); }
  /// False if it does not fit any more: then take_planning() gives it anew.
  bool end_own(Planning& planning, HostTime now) { return goals_.end_own(planning, now); }
  /// Stops the goal if it is still under way; it ends as Preempted. Nothing happens for any other id.
  void cancel(GoalId goal, HostTime now) { goals_.cancel(goal, now); }
  /// The next goal that has ended, oldest first.
  std::optional<GoalResult> take_goal_result() { return goals_.take_result(); }
  /// From now on goals are gone along so fast, the one under way too: paused where that is 0. A pause begins
  /// at once, another speed is for take_planning(). Or why not. Streams of setpoints are in their sender's
  /// time, and are refused during a pause.
  std::optional<Refusal> order_speed(const SpeedOrder& order, HostTime now) {
    return goals_.order_speed(order, now);
  }
  /// A sentence for the log, on what has become of such an order.
  std::optional<std::string> take_note() { return goals_.take_note(); }

  /// Takes a setpoint that has come at `now`, or says why not; the arm then goes on as it did.
  std::optional<Refusal> setpoint(const Setpoint& setpoint, HostTime now);

  /// Begins what is asked for. Each request ends with one result, at once or when the group is there.
  RequestId request(RequestKind kind, HostTime now);
  std::optional<RequestResult> take_request_result() { return requests_.take_result(); }

  /// Fills in what the group knows; buses are left alone. `out` is reused to avoid allocation.
  void snapshot(HostTime now, Snapshot& out) const;
  /// Figures of the last goal or stream that moved; those of emulated drives' samples are 0.
  MotionReport report() const;
  /// The committed trajectory at `time`, a state per joint. False, and `out` as it was, when `time` is before
  /// the start of the trajectory in force.
  bool query(HostTime time, std::vector<trajectory::State>& out) const { return drives_.query(time, out); }
  /// What the drives are playing or have played last.
  const Course& course() const { return drives_.course(); }

 private:
  void poll_starting(HostTime now);
  void poll_enabling(HostTime now);
  void poll_streaming(HostTime now);
  void poll_standing(HostTime now);
  void poll_stopping(HostTime now);
  void poll_fault(HostTime now);

  void start_enabling(HostTime now);
  void start_disabling(HostTime now);
  void disable(const std::string& why, HostTime now);
  void reset(HostTime now);
  void halt(HostTime now, const std::string& why);
  void rest(HostTime now);
  void enter_fault();
  std::optional<Refusal> refuse_now() const;

  GroupParameters parameters_;
  Drives drives_;
  bool enable_when_found_ = false;
  /// Whether the drives are to be switched off when nothing moves, or have been told to.
  enum class PowerOff { No, Wanted, Told };
  PowerOff power_off_ = PowerOff::No;
  std::string fault_;
  Goals goals_;
  Stream stream_;
  Requests requests_;
};

}  // namespace interpolated_motion::motion
