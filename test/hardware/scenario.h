#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::test {

/// A trajectory_msgs/JointTrajectory in YAML, as in config/goals.
trajectory::Goal load_goal(const std::string& file);
std::string goal_file(const std::string& name);

/// Goal of the joints `joint1`.. with positions (and velocities) per point.
trajectory::Goal make_goal(const std::vector<double>& times,
                           const std::vector<std::vector<double>>& positions,
                           const std::vector<std::vector<double>>& velocities = {});

/// Six joints as in config/six_axis_epos.yaml; `changes` is merged into it, maps recursively.
YAML::Node six_axis(const std::string& changes = "");
/// The same arm with only its first `count` joints.
YAML::Node arm_of(int count, const std::string& changes = "");
/// The same six joints with SilverLode drives as in config/six_axis_silverlode.yaml: three on line0, three on
/// line1.
YAML::Node six_axis_silverlode(const std::string& changes = "");
/// The same six joints with cyclic drives as in config/six_axis_cyclic.yaml.
YAML::Node six_axis_cyclic(const std::string& changes = "");
/// Two joints of each kind: cyclic and EPOS drives on one CAN bus, SilverLode drives on a serial line.
YAML::Node six_axis_of_all_kinds(const std::string& changes = "");
/// joint1..joint3 on a CAN bus, joint4..joint6 on a serial line, as in config/six_axis_mixed.yaml.
YAML::Node six_axis_mixed(const std::string& changes = "");
/// URDF limits of joint1..joint6: +-3.1 rad, 3.5 rad/s.
std::map<std::string, trajectory::JointLimits> six_axis_urdf();

/// The whole driver with emulated drives in virtual time.
class Scenario {
 public:
  explicit Scenario(const YAML::Node& parameters = six_axis(),
                    const std::map<std::string, trajectory::JointLimits>& urdf = six_axis_urdf());
  /// With kinds of drives of the test's own, which must outlive it.
  Scenario(const YAML::Node& parameters, const hardware::DriveKinds& kinds);

  hardware::MotionHardware& driver() { return *driver_; }
  HostTime now() const { return now_; }

  /// Runs for `seconds` of virtual time.
  void run(double seconds);
  /// Runs until `condition` holds, at most `seconds`; returns whether it does.
  bool run_until(const std::function<bool()>& condition, double seconds);
  bool run_until_state(motion::GroupState state, double seconds = 10.0);

  motion::GroupState state();
  motion::Snapshot snapshot();
  Expected<motion::GoalAcceptance, Refusal> submit(const trajectory::Goal& goal);
  /// Runs until the goal has ended; fails the test when it does not within `seconds`.
  motion::GoalResult result_of(motion::GoalId id, double seconds = 60.0);
  motion::RequestResult result_of_request(motion::RequestId id, double seconds = 10.0);
  /// Actual positions, rad or m.
  std::vector<double> positions();
  /// Texts logged so far.
  const std::vector<std::string>& log() const { return log_; }

 private:
  void collect();

  HostTime now_{};
  std::unique_ptr<hardware::MotionHardware> driver_;
  std::vector<motion::GoalResult> results_;
  std::vector<motion::RequestResult> request_results_;
  std::vector<std::string> log_;
};

}  // namespace interpolated_motion::test
