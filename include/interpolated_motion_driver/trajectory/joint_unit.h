#pragma once

namespace interpolated_motion::trajectory {

/// What the positions of a joint are in, as its type says: a prismatic joint has lengths, the others angles.
enum class JointUnit { Radian, Metre };

/// What a limit or a tolerance is about: a position in the joint's unit, that per s, or per s^2.
enum class Quantity { Position, Velocity, Acceleration };

/// "position", "velocity" or "acceleration".
const char* name(Quantity quantity);

/// "rad", "rad/s", "rad/s^2", or "m", "m/s", "m/s^2".
const char* symbol(JointUnit unit, Quantity quantity = Quantity::Position);

/// Of a prismatic joint, what an angle is of the others: its arc at a lever of this length, m.
inline constexpr double kLever = 0.1;

/// A constant that is made for angles, in the unit of a joint: `radians` (or rad/s, rad/s^2) as they are, or
/// m (m/s, m/s^2) at `kLever`. 0.05 rad become 5 mm.
double in_unit(JointUnit unit, double radians);

}  // namespace interpolated_motion::trajectory
