#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/bus_watch.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/motion/timed_paths.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/trajectory/speed_change.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

using GoalPtr = std::shared_ptr<const trajectory::Goal>;

/// A goal, or another speed of the one under way, between who wishes for it and the drives: all that planning
/// it needs, copied by Group::begin() on the thread that owns the buses, and what comes out of it. Nothing of
/// the group is touched meanwhile, so run() may take as long as it takes, on any thread; Group::end() then
/// takes the result, if it still fits.
class Planning {
 public:
  /// How the motion begins.
  enum class Entry {
    FromRest,  ///< where the drives rest
    Join,      ///< behind what the drives are committed to
    Wait,      ///< where they will rest; planned again then
    Stop,      ///< nothing to plan
  };

  /// What is known of an axis when planning begins.
  struct AxisPart {
    std::string bus;
    double record_bus_time = 0.0;  ///< s
    axis::BusWatch watch;
    axis::TailEncoderPtr encoder;
  };

  /// Of what joins.
  struct JoinPart {
    GoalTime join{0.0};     ///< goal time of the course from which on it is another one
    GoalTime present{0.0};  ///< goal time of the course when planning began
    GoalTime kept{0.0};     ///< what is older need not be remembered
    GoalTime linger{0.0};   ///< rest behind the motion before the drives leave
    TimedPaths course;
  };

  /// Of a motion that goes on at another speed.
  struct MotionPart {
    std::vector<trajectory::Path> nominal;
    GoalTime reached{0.0};  ///< nominal time, of a motion that has been paused and begins from rest
    GoalTime end{0.0};      ///< nominal time at which all joints stand
    GoalTime begin{0.0};    ///< nominal time at which the drives have set out, of a motion from rest
  };

  /// What was so when planning began: what is found later fits if it still is.
  struct Premises {
    std::uint64_t orders = 0;    ///< see Group::premises()
    std::uint64_t states = 0;    ///< entered by the group
    std::uint64_t revision = 0;  ///< of the course
    std::uint64_t speeds = 0;    ///< asked for
  };

  /// Plans, certifies and encodes the motion for all drives, and checks what their buses can carry. Once.
  void run();
  /// Whether the motion is not to begin before its speed is more than 0: there are no tails.
  bool is_paused() const { return entry != Entry::Join && speed.rate == 0.0; }

  // Given.

  Entry entry = Entry::FromRest;
  GoalPtr goal;             ///< null: `motion` goes on at another speed
  trajectory::Speed speed;  ///< to be gone along with
  trajectory::GoalRules rules;
  std::vector<trajectory::State> present;  ///< where the motion begins, per joint, in nominal time
  HostTime now{};                          ///< when it begins
  std::vector<AxisPart> axes;
  JoinPart joining;
  MotionPart motion;
  Premises premises;

  // Found.

  std::optional<Refusal> refusal;    ///< why it is not possible; then nothing below is set
  trajectory::GoalPlan plan;         ///< of a goal
  std::vector<axis::TailPtr> tails;  ///< of each axis
  TimedPaths course;                 ///< of what joins: the whole course with it
  GoalTime end{0.0};                 ///< when all joints stand, nominal time of the course

 private:
  std::optional<Refusal> plan_from_rest();
  std::optional<Refusal> plan_resume();
  std::optional<Refusal> plan_join();
  std::optional<Refusal> plan_goal_to_join();
  std::optional<Refusal> encode_at_speed(GoalTime from);
  std::optional<Refusal> encode();
  bool try_later();
  std::vector<trajectory::Path> nominal_with_goal(GoalTime join) const;
  std::vector<trajectory::Path> executed() const;
  GoalTime wait_for_samples();
  trajectory::Path executed_from_rest(std::size_t joint) const;
  trajectory::Path executed_behind_join(std::size_t joint) const;
};

using PlanningPtr = std::shared_ptr<Planning>;

}  // namespace interpolated_motion::motion
