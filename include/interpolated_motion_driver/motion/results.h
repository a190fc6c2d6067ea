#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// Names an accepted goal; never reused within a process. 0 names none.
using GoalId = std::uint64_t;

/// What the group answers when it takes a goal.
struct GoalAcceptance {
  GoalId id = 0;  ///< never 0 for a goal that was accepted
  /// From rest: from the start of motion to the last waypoint, lead-in included. In motion: from now on until
  /// all joints stand, those too that go on with a former goal.
  GoalTime duration{0.0};
  std::vector<std::string> warnings;  ///< e.g. points dropped because they lie in the past
};

enum class GoalOutcome {
  Succeeded,  ///< the last waypoint was reached and every joint settled within its goal tolerance
  Preempted,  ///< cancelled, or replaced by a newer goal; the group was brought to rest
  Aborted,    ///< a fault, a tolerance, or a goal that turned out impossible; the group was brought to rest
};

/// How an accepted goal ended. Reported once, when the motion has ended.
struct GoalResult {
  GoalId id = 0;                                 ///< as in its GoalAcceptance
  GoalOutcome outcome = GoalOutcome::Succeeded;  ///< decides whether `code` means anything
  GoalError code = GoalError::InvalidGoal;       ///< only for Aborted
  std::string text;                              ///< for the user; may be empty for Succeeded
};

/// Names a request (enable, reset, halt, clear) that takes time.
using RequestId = std::uint64_t;

/// How a request ended.
struct RequestResult {
  RequestId id = 0;      ///< as Group::request() has returned it
  bool success = false;  ///< the group is in the state that was asked for
  std::string message;   ///< what was done, or what prevented it and what to do
};

}  // namespace interpolated_motion::motion
