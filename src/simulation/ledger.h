#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/units/time.h"
#include "simulation/arm.h"

namespace interpolated_motion::simulation {

/// A goal that the driver has accepted.
struct GoalEntry {
  HostTime accepted{};
  HostTime due{};                                      ///< until when it must have ended
  std::vector<std::pair<std::size_t, double>> target;  ///< joint and where it is to come to rest, rad
  bool is_stop = false;                                ///< a goal without points
  bool met_motion = false;                             ///< something else was under way when it came
  std::string ended_by;                                ///< the order that ends it early; empty: none
  std::optional<motion::GoalResult> result;
};

/// A request (enable, reset, ...) that the driver has taken.
struct RequestEntry {
  std::string verb;
  HostTime made{};
  HostTime due{};
  std::optional<motion::RequestResult> result;
};

/// A fault that was injected.
struct FaultEntry {
  HostTime time{};
  std::string target;
  std::string command;
};

/// The host was not there.
struct Absence {
  HostTime from{};
  HostTime until{};
  bool tolerated = true;  ///< it must go unnoticed
};

/// What has been asked of the driver, what it has answered, and what was done to it. The invariants judge by
/// it.
class Ledger {
 public:
  explicit Ledger(Arm arm) : arm_(std::move(arm)) {}

  void accept(motion::GoalId id, GoalEntry entry);
  /// `verb` ends what is under way.
  void interrupt(const std::string& verb, HostTime now);
  void interrupt(motion::GoalId id, const std::string& verb, HostTime now);
  /// Goals take longer than they were sent for, or wait, from now on.
  void slow_down();
  void request(motion::RequestId id, const std::string& verb, HostTime now);
  /// Of an answer: nothing, or why it is none that may come.
  std::optional<std::string> take(const motion::GoalResult& result);
  std::optional<std::string> take(const motion::RequestResult& result);
  void add_setpoint(HostTime now, bool accepted);
  void add_fault(HostTime now, std::string target, std::string command);
  void add_absence(HostTime from, HostTime until);
  void die(HostTime now) { died_ = now; }
  void enter(motion::GroupState state, HostTime now);

  const Arm& arm() const { return arm_; }
  const std::map<motion::GoalId, GoalEntry>& goals() const { return goals_; }
  const std::map<motion::RequestId, RequestEntry>& requests() const { return requests_; }
  const std::vector<FaultEntry>& faults() const { return faults_; }
  motion::GroupState state() const { return state_; }
  motion::GroupState former_state() const { return former_state_; }
  HostTime state_since() const { return state_since_; }
  std::size_t setpoints_accepted() const { return setpoints_; }
  HostTime last_setpoint() const { return last_setpoint_; }
  /// The host has been there again since; HostTime{} when it was never away.
  HostTime last_absence() const { return absences_.empty() ? HostTime{} : absences_.back().until; }
  /// How many SYNCs `period` s apart may have been due while the host was away, in absences that have ended
  /// since `since`.
  std::uint32_t syncs_in_absences(HostTime since, double period) const;
  /// The host is away for longer than must go unnoticed: a drive that gets a target position each `period` s
  /// has come to the end of those it was sent, or is not led again yet.
  bool are_drives_alone(HostTime when, double period) const;
  HostTime last_fault() const { return faults_.empty() ? HostTime::min() : faults_.back().time; }
  bool is_dead() const { return died_ != kNever; }
  HostTime died() const { return died_; }

  bool has_open_goal() const;
  /// A request that may still be answered in time.
  bool has_open_request(HostTime now) const;
  /// Goals may be paused, or have been.
  bool is_slowed_down() const { return slowed_down_; }
  /// Something went wrong from outside: a fault, or the host was away for longer than must go unnoticed.
  bool is_disturbed() const { return disturbed_; }
  /// The joint or its bus had a fault within the last `within` s; ever, when nothing is given.
  bool is_touched(std::size_t joint, HostTime now, double within = 1e9) const;
  /// A joint or a bus of that name had a fault within the last `within` s.
  bool has_fault(const std::string& target, HostTime now, double within) const;
  /// Nothing was asked for since `when`: neither a goal nor a setpoint.
  bool has_order_since(HostTime when) const;
  bool has_request_since(const std::string& verb, HostTime when) const;

 private:
  double patience() const;
  void disturb(HostTime now);

  Arm arm_;
  std::map<motion::GoalId, GoalEntry> goals_;
  std::map<motion::RequestId, RequestEntry> requests_;
  std::vector<FaultEntry> faults_;
  motion::GroupState state_ = motion::GroupState::Starting;
  motion::GroupState former_state_ = motion::GroupState::Starting;
  HostTime state_since_{};
  HostTime last_setpoint_ = HostTime::min();
  std::vector<Absence> absences_;
  std::size_t setpoints_ = 0;
  bool disturbed_ = false;
  bool slowed_down_ = false;
  HostTime died_ = kNever;
};

}  // namespace interpolated_motion::simulation
