#pragma once

namespace interpolated_motion::encoding {

/// Simple transmission between a joint and the encoder of its motor:
/// counts = direction * (joint - offset) * ratio * counts_per_revolution / (2 pi).
/// The joint is revolute (rad); for a prismatic joint `ratio` is in motor radians per metre.
struct Transmission {
  double counts_per_revolution = 0.0;  ///< encoder counts (quadcounts, qc) per revolution of the motor, > 0
  double ratio = 1.0;                  ///< motor revolutions per revolution of the joint, > 0
  int direction = 1;                   ///< +1 or -1
  double offset = 0.0;                 ///< joint position (rad) at which the encoder reads 0

  double counts_per_radian() const;                       ///< signed
  double counts(double joint_position) const;             ///< actuator position in counts, not rounded
  double joint_position(double counts) const;             ///< rad
  double joint_velocity(double counts_per_second) const;  ///< rad/s
  double counts_per_second(double joint_velocity) const;  ///< signed
  double motor_rpm(double joint_velocity) const;          ///< signed, rpm of the motor
  double joint_velocity_from_rpm(double rpm) const;       ///< rad/s
};

}  // namespace interpolated_motion::encoding
