#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/bus_watch.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

using GoalPtr = std::shared_ptr<const trajectory::Goal>;

/// A goal between its sender and the drives: all that planning it needs, copied by Group::begin() on the
/// thread that owns the buses, and what comes out of it. Nothing of the group is touched meanwhile, so run()
/// may take as long as it takes, on any thread; Group::end() then takes the result, if it still fits.
class Planning {
 public:
  /// How the goal begins.
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

  /// Of a goal that joins.
  struct JoinPart {
    GoalTime join{0.0};                   ///< goal time of the course from which on it is the goal's
    GoalTime present{0.0};                ///< goal time of the course when planning began
    GoalTime kept{0.0};                   ///< what is older need not be remembered
    GoalTime linger{0.0};                 ///< rest behind the goal before the drives leave
    std::vector<trajectory::Path> paths;  ///< of the course
  };

  /// What was so when planning began: what is found later fits if it still is.
  struct Premises {
    std::uint64_t orders = 0;    ///< see Group::premises()
    std::uint64_t states = 0;    ///< entered by the group
    std::uint64_t revision = 0;  ///< of the course
  };

  /// Plans, certifies and encodes the goal for all drives, and checks what their buses can carry. Once.
  void run();

  // Given.

  Entry entry = Entry::FromRest;
  GoalPtr goal;
  trajectory::GoalRules rules;
  std::vector<trajectory::State> present;  ///< where the goal begins, per joint
  HostTime now{};                          ///< when it begins
  std::vector<AxisPart> axes;
  JoinPart joining;
  Premises premises;

  // Found.

  std::optional<Refusal> refusal;  ///< why the goal is not possible; then nothing below is set
  trajectory::GoalPlan plan;
  std::vector<axis::TailPtr> tails;     ///< of each axis
  std::vector<trajectory::Path> paths;  ///< of a goal that joins: the course with it
  GoalTime end{0.0};  ///< of a goal that joins: when all joints stand, goal time of the course

 private:
  std::optional<Refusal> plan_from_rest();
  std::optional<Refusal> plan_join();
  bool try_later();
  std::optional<Refusal> encode(const std::vector<trajectory::Path>& course);
  std::vector<trajectory::Path> course_with_goal() const;
};

using PlanningPtr = std::shared_ptr<Planning>;

}  // namespace interpolated_motion::motion
