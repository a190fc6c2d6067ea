#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/motion/active_goal.h"
#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/motion/course.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/requests.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/motion/setpoint_path.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/tolerances.h"
#include "interpolated_motion_driver/units/expected.h"

namespace interpolated_motion::motion {

struct GroupParameters {
  trajectory::GoalRules rules;        ///< names, order and limits of the joints
  trajectory::Tolerances tolerances;  ///< where a goal has none of its own
  HostDuration settle_timeout =
      std::chrono::milliseconds(500);  ///< used where a goal allows no time for settling
  bool enable_on_start = true;         ///< once all drives are configured, without being asked
  StreamParameters stream;             ///< delays and patience with setpoints
};

/// A group of axes that move together, on any mix of buses and kinds of drives. From rest a goal goes
/// through: checked and encoded whole for every axis, loaded into all FIFOs, common start, supervised,
/// settled. Whatever goes wrong on the way brings all axes to rest, and nothing moves again without a new
/// goal.
///
/// A goal that comes while the drives are under way joins: behind what is committed the course of all joints
/// is another one, without standing still. All axes take it at once, or none does, and the former motion
/// goes on.
///
/// Common start: axes that begin at the start signal of their bus all get it at once. Where others begin at
/// an instant they are told beforehand, the former rest for a while after their signal, and the latter are
/// told when that will be over.
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
  GroupState state() const { return state_; }
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
  void drop_planning() { holding_ = false; }
  /// What planning that is begun now stands on. `orders` counts what stops the group, and with it whatever
  /// has been sent before.
  Planning::Premises premises() const;
  /// The planning of a goal that has waited for rest, once it is due, to be given to end_waiting(); null
  /// without one.
  PlanningPtr take_planning(HostTime now);
  void end_waiting(Planning& planning, HostTime now);
  /// Stops the goal if it is still under way; it ends as Preempted. Nothing happens for any other id.
  void cancel(GoalId goal, HostTime now);
  /// The next goal that has ended, oldest first.
  std::optional<GoalResult> take_goal_result();

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
  bool query(HostTime time, std::vector<trajectory::State>& out) const;
  /// What the drives are playing or have played last.
  const Course& course() const { return course_; }

 private:
  void poll_starting(HostTime now);
  void poll_enabling(HostTime now);
  void poll_preparing(HostTime now);
  void poll_moving(HostTime now);
  void poll_settling(HostTime now);
  void poll_streaming(HostTime now);
  void poll_standing(HostTime now);
  void poll_stopping(HostTime now);
  void poll_fault(HostTime now);

  void start_enabling(HostTime now);
  void start_disabling(HostTime now);
  void disable(const std::string& why, HostTime now);
  void reset(HostTime now);
  void halt(HostTime now, const std::string& why);
  void stop(HostTime now, Ending ending);
  void abort_with_fault_of(const axis::Axis& axis, HostTime now);
  void enter(GroupState state);
  void enter_rest_state(HostTime now);
  void rest(HostTime now);
  void enter_fault();

  std::optional<Refusal> refuse_now() const;
  PlanningPtr begin_now(GoalPtr goal, HostTime now) const;
  PlanningPtr begin_waiting(GoalPtr goal, HostTime now) const;
  bool still_fits(const Planning& planning) const;
  bool ends_by_itself() const;
  GoalAcceptance wait_for_rest(const Planning& planning, HostTime now);
  GoalAcceptance join(Planning& planning, HostTime now);
  void hold(GoalTime allowance);
  void follow(std::vector<trajectory::Path> paths, std::vector<axis::TailPtr> tails);
  std::optional<GoalTime> changeable_from() const;
  GoalAcceptance accept_stop(HostTime now);
  void start_loading(GoalId id, Planning& planning, HostTime now);
  void start_motion(HostTime now);
  void set_common_begin(HostTime now);
  std::optional<Refusal> take_setpoint(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> open_stream(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> go_on_with_stream(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> follow_stream(const Setpoint& setpoint, HostTime now);
  void begin_stream(HostTime now);
  void join_stream(HostTime now);
  bool plays_course() const;
  void finish_goal(const Ending& ending);
  void finish_stop_goals(GoalOutcome outcome, const std::string& why = {});
  void fail_pending(const std::string& why, GoalOutcome outcome = GoalOutcome::Aborted);

  void sample_feedback();
  std::optional<Refusal> find_violation(bool at_goal);
  trajectory::State desired(std::size_t joint, HostTime when) const;

  bool in_motion() const;

  /// How far a stream has come: loading into the drives, on their way to its begin, following.
  enum class StreamStage { Loading, Beginning, Following };
  struct Stream {
    SetpointPath path;
    StreamStage stage = StreamStage::Following;
    std::optional<Setpoint> waiting{};  ///< the newest one, until the drives have begun
    StreamCounters counters{};
  };
  /// Scratch, at each axis' latest feedback.
  struct Tracking {
    std::vector<trajectory::State> desired;
    std::vector<trajectory::State> actual;
  };

  GroupParameters parameters_;
  Axes axes_;
  std::vector<axis::StartSignal*> signals_;
  GroupState state_ = GroupState::Starting;
  bool enable_when_found_ = false;
  /// Whether the drives are to be switched off when nothing moves, or have been told to.
  enum class PowerOff { No, Wanted, Told };
  PowerOff power_off_ = PowerOff::No;
  std::string fault_;
  HostTime in_force_since_ = kNever;  ///< start of the trajectory (or rest) that query() answers for

  Planning::Premises premises_;  ///< orders and states so far
  bool holding_ = false;         ///< while planning, for a goal that is to join
  GoalId next_goal_ = 1;
  Course course_;
  std::optional<ActiveGoal> active_;
  std::optional<LastMotion> last_;
  std::optional<PendingGoal> pending_;
  std::optional<Ending> ending_;
  Stream stream_;
  std::vector<GoalId> stop_goals_;
  std::deque<GoalResult> results_;
  Requests requests_;

  Tracking tracking_;
};

}  // namespace interpolated_motion::motion
