#include "interpolated_motion_driver/trajectory/joint_unit.h"

namespace interpolated_motion::trajectory {

const char* name(Quantity quantity) {
  switch (quantity) {
    case Quantity::Position:
      return "position";
    case Quantity::Velocity:
      return "velocity";
    case Quantity::Acceleration:
      break;
  }
  return "acceleration";
}

const char* symbol(JointUnit unit, Quantity quantity) {
  const bool turns = unit == JointUnit::Radian;
  switch (quantity) {
    case Quantity::Position:
      return turns ? "rad" : "m";
    case Quantity::Velocity:
      return turns ? "rad/s" : "m/s";
    case Quantity::Acceleration:
      break;
  }
  return turns ? "rad/s^2" : "m/s^2";
}

double in_unit(JointUnit unit, double radians) {
  return unit == JointUnit::Radian ? radians : kLever * radians;
}

}  // namespace interpolated_motion::trajectory
