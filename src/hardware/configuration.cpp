#include "interpolated_motion_driver/hardware/configuration.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/configuration_checks.h"
#include "interpolated_motion_driver/hardware/drive_kind.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::hardware {

namespace {

/// `all`: the driver's parameters, which have one start tolerance for all joints besides. What is given for
/// all is in the unit of each.
ConstraintConfiguration parse_constraints(ParameterReader& all,
                                          const std::vector<DriveConfiguration>& drives) {
  constexpr double kWidestStart = 10.0;
  ParameterReader reader = all.map("constraints");
  ConstraintConfiguration constraints;
  constraints.goal_time = reader.number("goal_time", constraints.goal_time, 0.0, 1e6);
  for (const DriveConfiguration& drive : drives) {
    const auto in_its_unit = [&drive](double value) { return trajectory::in_unit(drive.limits.unit, value); };
    ParameterReader entry = reader.map(drive.joint);
    ConstraintConfiguration::Joint& joint = constraints.joints[drive.joint];
    joint.trajectory = entry.number("trajectory", 0.0, 0.0, 1e6);
    joint.goal = entry.number("goal", 0.0, 0.0, 1e6);
    const double start = all.number("start_tolerance", in_its_unit(joint.start), 0.0, kWidestStart);
    joint.start = entry.number("start", start, 0.0, kWidestStart);
    joint.stopped_velocity =
        reader.number("stopped_velocity_tolerance", in_its_unit(joint.stopped_velocity), 0.0, 1e6);
    entry.refuse_unknown();
  }
  reader.refuse_unknown();
  return constraints;
}

motion::StreamParameters parse_setpoints(ParameterReader reader) {
  motion::StreamParameters stream;
  const auto time = [&reader](const char* key, GoalTime& value, double low, double high) {
    value = GoalTime{reader.number(key, value.count(), low, high)};
  };
  time("delay", stream.delay, 0.0, 1.0);
  time("horizon", stream.horizon, 0.05, 1.0);
  time("write_period", stream.write_period, 0.005, 1.0);
  time("linger", stream.linger, 0.0, 60.0);
  time("ride_through", stream.ride_through, 0.0, 1.0);
  time("max_age", stream.max_age, 0.0, 10.0);
  time("max_ahead", stream.max_ahead, 0.0, 10.0);
  time("catch_up", stream.catch_up, 0.0, 10.0);
  reader.refuse_unknown();
  return stream;
}

/// Parameters as for a controller of ros_control stand under the controller's name.
void refuse_nested(const ParameterReader& reader) {
  if (reader.has("joints")) return;
  for (const std::string& key : reader.keys()) {
    const YAML::Node value = reader.node()[key];
    if (!value.IsMap() || !value["joints"].IsDefined()) continue;
    reader.fail("joints",
                fmt::format("is missing, and there is {0}/joints: the configuration stands under the name "
                            "{0}. Take that level away, or give the node that name and load the file "
                            "beside it, not into it",
                            key));
  }
}

std::string source_of(const YAML::Node& parameters, const std::vector<std::string>& node_keys) {
  YAML::Node own(YAML::NodeType::Map);
  for (const auto& entry : parameters) {
    const auto key = entry.first.as<std::string>();
    if (std::find(node_keys.begin(), node_keys.end(), key) == node_keys.end()) own[key] = entry.second;
  }
  return recording::one_line(own);
}

void mark_isochronous_buses(Configuration& configuration) {
  for (const DriveConfiguration& drive : configuration.drives) {
    if (!drive.kind->follows_host_time()) continue;
    for (BusConfiguration& bus : configuration.buses) {
      if (bus.name == drive.bus) bus.isochronous = true;
    }
  }
}

}  // namespace

const BusConfiguration& Configuration::bus_of(const DriveConfiguration& drive) const {
  const auto found = std::find_if(buses.begin(), buses.end(),
                                  [&drive](const BusConfiguration& bus) { return bus.name == drive.bus; });
  if (found != buses.end()) return *found;
  throw std::invalid_argument(fmt::format(
      "Parameter drives/{}/bus is \"{}\", which is not among buses. Add it there or correct the name.",
      drive.joint, drive.bus));
}

Configuration parse_configuration(const YAML::Node& parameters, const UrdfLimits& urdf,
                                  const std::vector<std::string>& node_keys, const DriveKinds& kinds) {
  ParameterReader reader(parameters, "");
  Configuration configuration;
  refuse_nested(reader);
  configuration.joints = reader.names("joints");
  ParameterReader buses = reader.map("buses");
  for (const std::string& name : buses.keys())
    configuration.buses.push_back(parse_bus(name, buses.map(name)));
  ParameterReader drives = reader.map("drives");
  for (const std::string& joint : configuration.joints) {
    if (!drives.has(joint)) drives.fail(joint, "is missing: every joint of `joints` needs a drive");
    configuration.drives.push_back(parse_drive(joint, drives.map(joint), urdf, kinds));
  }
  drives.refuse_unknown();
  configuration.constraints = parse_constraints(reader, configuration.drives);
  auto& c = configuration;
  c.setpoints = parse_setpoints(reader.map("setpoints"));
  c.stop_trajectory_duration =
      reader.number("stop_trajectory_duration", c.stop_trajectory_duration, 0.0, 60.0);
  c.speed_ramp = reader.number("speed_ramp", c.speed_ramp, 0.05, 60.0);
  c.allow_partial_joints_goal = reader.boolean("allow_partial_joints_goal", c.allow_partial_joints_goal);
  c.join_late = reader.choice("join", c.join_late, {{"refuse", false}, {"late", true}});
  c.max_start_ahead = reader.number("max_start_ahead", c.max_start_ahead, 1.0, 1e6);
  c.commit_horizon = reader.number("commit_horizon", c.commit_horizon, 0.1, 60.0);
  c.bring_up_timeout = reader.number("bring_up_timeout", c.bring_up_timeout, 0.5, 600.0);
  c.settle_timeout = reader.number("settle_timeout", c.settle_timeout, 0.0, 600.0);
  c.enable_on_start = reader.boolean("enable_on_start", c.enable_on_start);
  c.flight_recorder = parse_flight_recorder(reader.map("flight_recorder"));
  c.source = source_of(parameters, node_keys);
  c.urdf = urdf;
  for (const std::string& key : node_keys) reader.ignore(key);
  reader.refuse_unknown();
  check_parts(configuration);
  mark_isochronous_buses(configuration);
  check_background_load(configuration);
  return configuration;
}

}  // namespace interpolated_motion::hardware
