#pragma once

#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/motion/timed_paths.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/trajectory/time_law.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// What all joints do from the begin of a motion to the rest behind it, whoever has asked for it: one path
/// per joint, all in the same goal time. While the drives are under way the paths may change from some
/// instant on that the drives have not been told yet.
class Course {
 public:
  /// Another motion: nothing of the former is left.
  void begin(TimedPaths paths);
  /// The same motion with other paths, the same as before up to an instant that is still to come.
  void change(TimedPaths paths);

  /// What is executed: one path per joint, in the order of the configuration; none before the first motion.
  const std::vector<trajectory::Path>& paths() const { return timed_.executed; }
  /// What stands behind it.
  const TimedPaths& timed() const { return timed_; }
  const trajectory::TimeLaw& law() const { return timed_.law; }
  /// Counts the motions begun, and all changes of paths().
  std::uint64_t motion() const { return motion_; }
  std::uint64_t revision() const { return revision_; }

  /// States of all joints at `time`.
  std::vector<trajectory::State> at(GoalTime time) const;
  /// When the last joint is at the end of its path.
  GoalTime end() const;
  /// The path of `joint` up to `join`, what is older than `kept` left out, and `tail` behind it.
  trajectory::Path joined(std::size_t joint, GoalTime kept, GoalTime join,
                          const trajectory::Path& tail) const;

 private:
  TimedPaths timed_;
  std::uint64_t motion_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace interpolated_motion::motion
