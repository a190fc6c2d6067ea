#pragma once

#include <cstdint>

namespace interpolated_motion::encoding {

/// Simple transmission between a joint and the encoder of its motor:
/// counts = direction * (joint - offset) * ratio * counts_per_revolution / (2 pi).
/// Positions of the joint are in rad; in m where it is prismatic.
struct Transmission {
  double counts_per_revolution = 0.0;  ///< encoder counts (quadcounts, qc) per revolution of the motor, > 0
  /// Motor revolutions per revolution of the joint, > 0; of a prismatic joint see ratio_of_travel().
  double ratio = 1.0;
  int direction = 1;    ///< +1 or -1
  double offset = 0.0;  ///< joint position (rad or m) at which the encoder reads 0

  /// The ratio of a prismatic joint that the motor moves by `travel` m a revolution, > 0: radians of the
  /// motor per m.
  static double ratio_of_travel(double travel);

  double counts_per_radian() const;                          ///< signed; per m of a prismatic joint
  double counts(double joint_position) const;                ///< actuator position in counts, not rounded
  std::int32_t nearest_counts(double joint_position) const;  ///< that, rounded; an encoder's last if beyond
  double joint_position(double counts) const;                ///< rad or m
  double joint_velocity(double counts_per_second) const;     ///< rad/s or m/s
  double counts_per_second(double joint_velocity) const;     ///< signed
  double motor_rpm(double joint_velocity) const;             ///< signed, rpm of the motor
  double joint_velocity_from_rpm(double rpm) const;          ///< rad/s or m/s
};

}  // namespace interpolated_motion::encoding
