#include "hardware/scenario.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace interpolated_motion::test {

namespace {

std::vector<double> numbers(const YAML::Node& node) {
  return node.IsDefined() ? node.as<std::vector<double>>() : std::vector<double>{};
}

GoalTime time_of(const YAML::Node& node) {
  if (node.IsScalar()) return GoalTime{node.as<double>()};
  return GoalTime{node["secs"].as<double>() + 1e-9 * node["nsecs"].as<double>()};
}

void merge(YAML::Node into, const YAML::Node& changes) {
  for (const auto& entry : changes) {
    const auto key = entry.first.as<std::string>();
    if (entry.second.IsMap() && into[key].IsDefined() && into[key].IsMap()) {
      merge(into[key], entry.second);
    } else {
      into[key] = entry.second;
    }
  }
}

}  // namespace

std::string goal_file(const std::string& name) {
  return std::string(IMD_SOURCE_DIR) + "/config/goals/" + name;
}

trajectory::Goal load_goal(const std::string& file) {
  const YAML::Node yaml = YAML::LoadFile(file);
  trajectory::Goal goal;
  goal.joint_names = yaml["joint_names"].as<std::vector<std::string>>();
  for (const auto& point : yaml["points"]) {
    goal.points.push_back({time_of(point["time_from_start"]),
                           numbers(point["positions"]),
                           numbers(point["velocities"]),
                           numbers(point["accelerations"]),
                           {}});
  }
  return goal;
}

trajectory::Goal make_goal(const std::vector<double>& times,
                           const std::vector<std::vector<double>>& positions,
                           const std::vector<std::vector<double>>& velocities) {
  trajectory::Goal goal;
  for (std::size_t j = 0; j < positions.front().size(); ++j)
    goal.joint_names.push_back(fmt::format("joint{}", j + 1));
  for (std::size_t i = 0; i < times.size(); ++i) {
    trajectory::Waypoint point;
    point.time = GoalTime{times[i]};
    point.positions = positions[i];
    if (!velocities.empty()) point.velocities = velocities[i];
    goal.points.push_back(point);
  }
  return goal;
}

YAML::Node arm_of(int count, const std::string& changes) {
  YAML::Node yaml = YAML::Load("{buses: {can0: {type: canopen, transport: emulated}}}");
  for (int i = 1; i <= count; ++i) {
    const std::string joint = fmt::format("joint{}", i);
    yaml["joints"].push_back(joint);
    yaml["drives"][joint] = YAML::Load(
        fmt::format("{{bus: can0, type: epos_ipm, node_id: {}, counts_per_revolution: 2000, gear_ratio: 100, "
                    "limits: {{max_acceleration: 20}}}}",
                    i));
  }
  if (!changes.empty()) merge(yaml, YAML::Load(changes));
  return yaml;
}

YAML::Node six_axis(const std::string& changes) { return arm_of(6, changes); }

YAML::Node silverlode_drive(const std::string& line, int address) {
  return YAML::Load(fmt::format(
      "{{bus: {}, type: silverlode_ims, address: {}, counts_per_revolution: 4000, gear_ratio: 50, "
      "limits: {{max_acceleration: 20}}}}",
      line, address));
}

YAML::Node six_axis_silverlode(const std::string& changes) {
  YAML::Node yaml = YAML::Load("{buses: {line0: {type: silverlode}, line1: {type: silverlode}}}");
  for (int i = 1; i <= 6; ++i) {
    const std::string joint = fmt::format("joint{}", i);
    yaml["joints"].push_back(joint);
    yaml["drives"][joint] = silverlode_drive(i <= 3 ? "line0" : "line1", 15 + i);
  }
  if (!changes.empty()) merge(yaml, YAML::Load(changes));
  return yaml;
}

YAML::Node cyclic_drive(int node_id) {
  return YAML::Load(
      fmt::format("{{bus: can0, type: cyclic, node_id: {}, counts_per_revolution: 2000, gear_ratio: 100, "
                  "limits: {{max_acceleration: 20}}}}",
                  node_id));
}

YAML::Node six_axis_cyclic(const std::string& changes) {
  YAML::Node yaml = arm_of(6);
  for (int i = 1; i <= 6; ++i) yaml["drives"][fmt::format("joint{}", i)] = cyclic_drive(i);
  if (!changes.empty()) merge(yaml, YAML::Load(changes));
  return yaml;
}

YAML::Node six_axis_of_all_kinds(const std::string& changes) {
  YAML::Node yaml = arm_of(6, "{buses: {line0: {type: silverlode}}}");
  for (int i = 1; i <= 2; ++i) yaml["drives"][fmt::format("joint{}", i)] = cyclic_drive(i);
  for (int i = 5; i <= 6; ++i) yaml["drives"][fmt::format("joint{}", i)] = silverlode_drive("line0", 12 + i);
  if (!changes.empty()) merge(yaml, YAML::Load(changes));
  return yaml;
}

YAML::Node six_axis_mixed(const std::string& changes) {
  YAML::Node yaml = arm_of(3, "{buses: {line0: {type: silverlode}}}");
  for (int i = 4; i <= 6; ++i) {
    const std::string joint = fmt::format("joint{}", i);
    yaml["joints"].push_back(joint);
    yaml["drives"][joint] = silverlode_drive("line0", 12 + i);
  }
  if (!changes.empty()) merge(yaml, YAML::Load(changes));
  return yaml;
}

std::map<std::string, trajectory::JointLimits> six_axis_urdf() {
  std::map<std::string, trajectory::JointLimits> limits;
  for (int i = 1; i <= 6; ++i) {
    trajectory::JointLimits joint;
    joint.min_position = -3.1;
    joint.max_position = 3.1;
    joint.max_velocity = 3.5;
    limits[fmt::format("joint{}", i)] = joint;
  }
  return limits;
}

Scenario::Scenario(const YAML::Node& parameters, const std::map<std::string, trajectory::JointLimits>& urdf)
    : driver_(std::make_unique<hardware::MotionHardware>(hardware::parse_configuration(parameters, urdf),
                                                         now_)) {}

Scenario::Scenario(const YAML::Node& parameters, const hardware::DriveKinds& kinds)
    : driver_(std::make_unique<hardware::MotionHardware>(
          hardware::parse_configuration(parameters, six_axis_urdf(), {}, kinds), now_)) {}

void Scenario::run(double seconds) {
  run_until([] { return false; }, seconds);
}

bool Scenario::run_until(const std::function<bool()>& condition, double seconds) {
  const HostTime end = now_ + host_duration(seconds);
  while (!condition()) {
    if (now_ >= end) return false;
    now_ = std::min(end, now_ + std::chrono::milliseconds(1));
    driver_->update(now_);
    collect();
  }
  return true;
}

bool Scenario::run_until_state(motion::GroupState wanted, double seconds) {
  return run_until([this, wanted] { return state() == wanted; }, seconds);
}

void Scenario::collect() {
  while (auto result = driver_->take_goal_result()) results_.push_back(*result);
  while (auto result = driver_->take_request_result()) request_results_.push_back(*result);
  while (auto entry = driver_->take_log()) log_.push_back(entry->text);
}

motion::Snapshot Scenario::snapshot() {
  motion::Snapshot snapshot;
  driver_->snapshot(snapshot);
  return snapshot;
}

motion::GroupState Scenario::state() { return snapshot().state; }

Expected<motion::GoalAcceptance, Refusal> Scenario::submit(const trajectory::Goal& goal) {
  return driver_->submit(goal, now_);
}

motion::GoalResult Scenario::result_of(motion::GoalId id, double seconds) {
  const auto find = [this, id] {
    return std::find_if(results_.begin(), results_.end(),
                        [id](const motion::GoalResult& r) { return r.id == id; });
  };
  if (!run_until([&] { return find() != results_.end(); }, seconds)) {
    ADD_FAILURE() << "goal " << id << " has not ended; the group is " << motion::to_string(state());
    return {};
  }
  return *find();
}

motion::RequestResult Scenario::result_of_request(motion::RequestId id, double seconds) {
  const auto find = [this, id] {
    return std::find_if(request_results_.begin(), request_results_.end(),
                        [id](const motion::RequestResult& r) { return r.id == id; });
  };
  if (!run_until([&] { return find() != request_results_.end(); }, seconds)) {
    ADD_FAILURE() << "request " << id << " has not ended; the group is " << motion::to_string(state());
    return {};
  }
  return *find();
}

std::vector<double> Scenario::positions() {
  std::vector<double> positions;
  for (const motion::JointSnapshot& joint : snapshot().joints) positions.push_back(joint.actual.position);
  return positions;
}

}  // namespace interpolated_motion::test
