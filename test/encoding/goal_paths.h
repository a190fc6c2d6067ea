#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::encoding::testing {

/// One end of a piece: position, velocity, acceleration.
struct End {
  double p = 0.0;
  double v = 0.0;
  double a = 0.0;
};

/// The cubic through position and velocity at both ends of `h` seconds.
inline trajectory::Polynomial cubic_between(const End& from, const End& to, double h) {
  const double d = to.p - from.p;
  trajectory::Polynomial polynomial;
  polynomial.coefficients = {from.p,
                             from.v,
                             (3 * d - (2 * from.v + to.v) * h) / (h * h),
                             ((from.v + to.v) * h - 2 * d) / (h * h * h),
                             0,
                             0};
  return polynomial;
}

/// The quintic through position, velocity and acceleration at both ends of `h` seconds.
inline trajectory::Polynomial quintic_between(const End& from, const End& to, double h) {
  const double d = to.p - from.p;
  const double h3 = h * h * h;
  trajectory::Polynomial polynomial;
  polynomial.coefficients = {
      from.p,
      from.v,
      from.a / 2,
      (20 * d - (8 * to.v + 12 * from.v) * h - (3 * from.a - to.a) * h * h) / (2 * h3),
      (-30 * d + (14 * to.v + 16 * from.v) * h + (3 * from.a - 2 * to.a) * h * h) / (2 * h3 * h),
      (12 * d - 6 * (to.v + from.v) * h + (to.a - from.a) * h * h) / (2 * h3 * h * h)};
  return polynomial;
}

/// A path through `ends` at `times` (s).
inline trajectory::Path path_through(const std::vector<double>& times, const std::vector<End>& ends,
                                     bool quintic) {
  std::vector<trajectory::Piece> pieces;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double h = times[i + 1] - times[i];
    pieces.push_back(
        {GoalTime(times[i]), GoalTime(times[i + 1]),
         quintic ? quintic_between(ends[i], ends[i + 1], h) : cubic_between(ends[i], ends[i + 1], h)});
  }
  return trajectory::Path(std::move(pieces));
}

/// The paths of all joints of a goal file: quintic where the points carry accelerations, else cubic.
inline std::vector<trajectory::Path> goal_paths(const std::string& file) {
  const YAML::Node goal = YAML::LoadFile(file);
  const YAML::Node points = goal["points"];
  const bool quintic = points[0]["accelerations"].IsDefined() && points[0]["accelerations"].size() > 0;
  std::vector<trajectory::Path> paths;
  for (std::size_t joint = 0; joint < goal["joint_names"].size(); ++joint) {
    std::vector<double> times;
    std::vector<End> ends;
    for (const YAML::Node& point : points) {
      const YAML::Node time = point["time_from_start"];
      times.push_back(time["secs"].as<double>() + 1e-9 * time["nsecs"].as<double>());
      ends.push_back({point["positions"][joint].as<double>(), point["velocities"][joint].as<double>(),
                      quintic ? point["accelerations"][joint].as<double>() : 0.0});
    }
    paths.push_back(path_through(times, ends, quintic));
  }
  return paths;
}

}  // namespace interpolated_motion::encoding::testing
