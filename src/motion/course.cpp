#include "interpolated_motion_driver/motion/course.h"

#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::motion {

void Course::begin(TimedPaths paths) {
  ++motion_;
  change(std::move(paths));
}

void Course::change(TimedPaths paths) {
  timed_ = std::move(paths);
  ++revision_;
}

std::vector<trajectory::State> Course::at(GoalTime time) const {
  std::vector<trajectory::State> states;
  states.reserve(paths().size());
  for (const trajectory::Path& path : paths()) states.push_back(path.sample(time));
  return states;
}

GoalTime Course::end() const {
  GoalTime end{0.0};
  for (const trajectory::Path& path : paths()) end = std::max(end, path.end_time());
  return end;
}

trajectory::Path Course::joined(std::size_t joint, GoalTime kept, GoalTime join,
                                const trajectory::Path& tail) const {
  return trajectory::splice(paths()[joint], kept, join, tail);
}

}  // namespace interpolated_motion::motion
