#pragma once

namespace interpolated_motion::trajectory {

/// Velocity at a knot between two segments, `before` and `after` being their lengths (> 0 s) and mean
/// velocities, with which cubic segments neither overshoot nor oscillate: zero at a local extremum, otherwise
/// the slope of the parabola through the three knots, limited to twice the smaller mean velocity. M. Steffen,
/// "A simple method for monotonic interpolation in one dimension", Astron. Astrophys. 239 (1990), eq. 11. It
/// depends on the two neighbours only, so a spliced goal leaves the rest of the path alone, and the spacing
/// may be uneven.
double shape_preserving_slope(double length_before, double slope_before, double length_after,
                              double slope_after);

}  // namespace interpolated_motion::trajectory
