#pragma once

#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/time_law.h"

namespace interpolated_motion::motion {

/// A motion as it was wished for and as it is executed: a path per joint of each, in the order of the
/// configuration.
struct TimedPaths {
  std::vector<trajectory::Path> nominal;   ///< in nominal time, as at speed 1
  trajectory::TimeLaw law{1.0};            ///< how fast all of them are gone along
  std::vector<trajectory::Path> executed;  ///< in goal time: the nominal ones by the law
};

/// What is executed as it was wished for.
inline TimedPaths at_own_speed(std::vector<trajectory::Path> paths) {
  return {paths, trajectory::TimeLaw{}, std::move(paths)};
}

}  // namespace interpolated_motion::motion
