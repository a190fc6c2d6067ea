#pragma once

#include <map>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::simulation {

/// What the simulation knows of a joint: read from the configuration's text by itself, not from what the
/// driver has made of it.
struct Joint {
  std::string name;
  std::string bus;
  std::string kind;                ///< type of its drive: epos_ipm, silverlode_ims, cyclic
  double counts_per_radian = 1.0;  ///< of the drive's encoder, below 0 where it turns the other way
  double offset = 0.0;             ///< rad
  double min_position = 0.0;       ///< rad
  double max_position = 0.0;       ///< rad
  double max_velocity = 0.0;       ///< rad/s
  double max_acceleration = 0.0;   ///< rad/s^2
  double limit_margin = 1.2;       ///< by which a record may exceed the limits
  double difference =
      0.001;  ///< s, over which velocity and acceleration of its demand are held against limits
  double sample_period = 0.001;  ///< s, nominal, of the drive's demand
  double target_period = 0.0;    ///< s, between target positions, which are whole counts; 0: it gets records
  double deviation_bound = 1.0;  ///< counts
  double joining_bound = 8.0;    ///< counts, of a goal that has taken over in motion

  double position(double counts) const { return offset + counts / counts_per_radian; }  ///< rad
  std::string label() const { return name + " (" + kind + ")"; }
  double count() const;  ///< rad, above 0
};

/// What the simulation knows of an arm.
struct Arm {
  std::vector<Joint> joints;
  double commit_horizon = 0.5;    ///< s
  double settle_time = 0.5;       ///< s
  double bring_up_timeout = 5.0;  ///< s
  bool enable_on_start = true;
  bool allow_partial = false;

  bool has(const std::string& kind) const;
  /// Absence of the host that must not be noticed whatever the group is doing, s.
  double tolerated_absence() const;
  /// The same of an absence that begins in `state`.
  double tolerated_absence(motion::GroupState state) const;
};

/// Throws std::invalid_argument or YAML::Exception where the text is not that of an arm.
Arm read_arm(const std::string& configuration);

/// Limits of joint1..joint12 as a robot description would give them: +-3.1 rad, 3.5 rad/s.
std::map<std::string, trajectory::JointLimits> robot_description();

}  // namespace interpolated_motion::simulation
