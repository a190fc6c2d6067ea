#include "simulation/arm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace interpolated_motion::simulation {

namespace {

constexpr double kReach = 3.1;     // rad
constexpr double kVelocity = 3.5;  // rad/s
constexpr double kAccelerating =
    0.1;  // s, docs/configuration.md: limits/max_acceleration where none is given
constexpr int kMostJoints = 12;
constexpr double kPi = 3.14159265358979324;

template <class Value>
Value read(const YAML::Node& map, const char* key, Value otherwise) {
  return map && map[key] ? map[key].as<Value>() : otherwise;
}

void read_limits(const YAML::Node& limits, Joint& joint) {
  joint.min_position = read(limits, "min_position", -kReach);
  joint.max_position = read(limits, "max_position", kReach);
  joint.max_velocity = read(limits, "max_velocity", kVelocity);
  joint.max_acceleration = read(limits, "max_acceleration", joint.max_velocity / kAccelerating);
}

// Defaults are those of docs/configuration.md.
void read_kind(const YAML::Node& drive, const YAML::Node& bus, Joint& joint) {
  joint.kind = read<std::string>(drive, "type", "epos_ipm");
  const bool is_serial = joint.kind == "silverlode_ims";
  const bool is_cyclic = joint.kind == "cyclic";
  const double bound = is_serial ? 2.0 : is_cyclic ? 5.0 : 1.0;
  joint.deviation_bound = read(drive, "deviation_bound", bound);
  const double of_stream = is_serial ? 0.02 / joint.count() : 8.0 * joint.deviation_bound;
  joint.joining_bound = is_cyclic ? joint.deviation_bound : read(drive, "stream_deviation_bound", of_stream);
  if (is_serial) joint.sample_period = read(drive, "tick", 0.00012);
  if (!is_cyclic) return;
  joint.sample_period = read(drive, "servo_period", 0.001);
  joint.target_period = read(bus, "sync_period", 0.01);
  // Between two targets, linear and quadratic interpolation have steps of velocity and acceleration that no
  // host can avoid.
  if (read(drive, "interpolation_order", 3) < 3) joint.difference = joint.target_period;
}

Joint read_joint(const std::string& name, const YAML::Node& drive, const YAML::Node& buses) {
  Joint joint;
  joint.name = name;
  joint.bus = drive["bus"].as<std::string>();
  joint.counts_per_radian = drive["counts_per_revolution"].as<double>() * read(drive, "gear_ratio", 1.0) *
                            read(drive, "direction", 1.0) / (2.0 * kPi);
  joint.offset = read(drive, "offset", 0.0);
  joint.limit_margin = read(drive, "limit_margin", 1.2);
  read_limits(drive["limits"], joint);
  read_kind(drive, buses ? buses[joint.bus] : YAML::Node(), joint);
  return joint;
}

}  // namespace

double Joint::count() const { return 1.0 / std::abs(counts_per_radian); }

bool Arm::has(const std::string& kind) const {
  return std::any_of(joints.begin(), joints.end(),
                     [&kind](const Joint& joint) { return joint.kind == kind; });
}

// A cyclic drive is sent a target at each SYNC, three ahead: of a period of 5 ms or more an absence of 4 ms
// takes none away. Buffered drives hold `commit_horizon` of a goal, and at least 0.1 s of a stream
// (docs/setpoints.md).
double Arm::tolerated_absence() const {
  if (has("cyclic")) return 0.004;
  return std::min(0.05, 0.3 * commit_horizon);
}

// At rest only a cyclic drive needs its host. EPOS drives play what is in their FIFOs, whose fill is known to
// be `commit_horizon`, and brake by themselves; how long a queue of a few segments lasts depends on the
// segments.
double Arm::tolerated_absence(motion::GroupState state) const {
  using motion::GroupState;
  constexpr double kPromised = 0.1;  // s, less than commit_horizon: docs/buses.md
  if (has("cyclic")) return tolerated_absence();
  if (state == GroupState::Idle || state == GroupState::Disabled) return std::numeric_limits<double>::max();
  if (has("silverlode_ims") || state == GroupState::Streaming) return tolerated_absence();
  return std::max(tolerated_absence(), commit_horizon - kPromised);
}

Arm read_arm(const std::string& configuration) {
  const YAML::Node yaml = YAML::Load(configuration);
  Arm arm;
  for (const auto& name : yaml["joints"].as<std::vector<std::string>>()) {
    arm.joints.push_back(read_joint(name, yaml["drives"][name], yaml["buses"]));
  }
  arm.commit_horizon = read(yaml, "commit_horizon", arm.commit_horizon);
  arm.settle_time = read(yaml, "settle_timeout", arm.settle_time);
  const YAML::Node constraints = yaml["constraints"];
  arm.settle_time = std::max(arm.settle_time, read(constraints, "goal_time", 0.0));
  arm.bring_up_timeout = read(yaml, "bring_up_timeout", arm.bring_up_timeout);
  arm.enable_on_start = read(yaml, "enable_on_start", true);
  arm.allow_partial = read(yaml, "allow_partial_joints_goal", false);
  return arm;
}

std::map<std::string, trajectory::JointLimits> robot_description() {
  std::map<std::string, trajectory::JointLimits> limits;
  for (int i = 1; i <= kMostJoints; ++i) {
    trajectory::JointLimits joint;
    joint.min_position = -kReach;
    joint.max_position = kReach;
    joint.max_velocity = kVelocity;
    limits[fmt::format("joint{}", i)] = joint;
  }
  return limits;
}

}  // namespace interpolated_motion::simulation
