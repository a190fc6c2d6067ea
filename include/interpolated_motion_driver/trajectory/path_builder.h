#pragma once

#include <vector>

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// How much of a knot's state is given.
enum class KnotData { Position, Velocity, Acceleration };

/// A point of one joint that its path goes through.
struct Knot {
  GoalTime time{0.0};                   ///< at which the path goes through it
  State state;                          ///< the members that `given` does not cover are ignored
  KnotData given = KnotData::Position;  ///< `Velocity`: position and velocity; `Acceleration`: all three
};

/// Path through `knots` (two or more, strictly increasing in time), per segment as
/// joint_trajectory_controller: quintic if accelerations are given at both ends, cubic otherwise. A velocity
/// that is not given is zero at the first and the last knot and shape-preserving between
/// (`shape_preserving_slope`), where joint_trajectory_controller would be linear with steps in velocity:
/// knots with positions only make a C1 path that does not leave the range of the two knots around it. Throws
/// std::invalid_argument for fewer than two knots or times that do not increase.
Path build_path(const std::vector<Knot>& knots);

/// The velocity of such a path at `knot` between two others, where it is not given: rad/s or m/s.
double velocity_between(const Knot& before, const Knot& knot, const Knot& after);

/// The pieces of `build_path`, appended to `pieces`.
void append_pieces(const std::vector<Knot>& knots, std::vector<Piece>& pieces);

}  // namespace interpolated_motion::trajectory
