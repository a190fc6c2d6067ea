#include "interpolated_motion_driver/hardware/motion_hardware.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/epos_axis.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/can_link.h"
#include "interpolated_motion_driver/hardware/fault_injection.h"
#include "interpolated_motion_driver/hardware/path_audit.h"
#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::hardware {

namespace {

/// A position nearer to a goal's first point than half a count is at that point, for a drive that knows whole
/// counts.
constexpr double kLeadInCounts = 0.5;
/// Shortest step of the loop: deadlines that lie closer together are served together.
constexpr HostDuration kShortestStep = std::chrono::microseconds(50);

axis::EposAxisParameters axis_parameters(const Configuration& configuration, const DriveConfiguration& drive,
                                         const BusConfiguration& bus, double record_bus_time) {
  axis::EposAxisParameters parameters;
  parameters.joint = drive.joint;
  parameters.transmission = drive.transmission;
  parameters.limits = drive.limits;
  parameters.deviation_bound = drive.deviation_bound;
  parameters.limit_margin = drive.limit_margin;
  parameters.max_following_error = drive.max_following_error;
  parameters.commit_horizon = configuration.commit_horizon;
  parameters.record_bus_time = record_bus_time;
  parameters.host_node_id = static_cast<std::uint8_t>(bus.host_node_id);
  parameters.clock_discipline = bus.clock_discipline;
  parameters.heartbeat_period = host_duration(bus.heartbeat_period);
  parameters.heartbeat_timeout = host_duration(bus.heartbeat_timeout);
  parameters.bring_up_timeout = host_duration(configuration.bring_up_timeout);
  return parameters;
}

motion::GroupParameters group_parameters(const Configuration& configuration) {
  motion::GroupParameters parameters;
  std::vector<double> path;
  std::vector<double> goal;
  for (const DriveConfiguration& drive : configuration.drives) {
    parameters.rules.joints.push_back(drive.joint);
    parameters.rules.limits.push_back(drive.limits);
    parameters.rules.start_tolerance.push_back(configuration.start_tolerance);
    parameters.rules.lead_in_threshold.push_back(kLeadInCounts /
                                                 std::abs(drive.transmission.counts_per_radian()));
    const auto found = configuration.constraints.joints.find(drive.joint);
    const bool known = found != configuration.constraints.joints.end();
    path.push_back(known ? found->second.trajectory : 0.0);
    goal.push_back(known ? found->second.goal : 0.0);
  }
  parameters.rules.allow_partial_joints = configuration.allow_partial_joints_goal;
  parameters.tolerances = trajectory::default_tolerances(
      path, goal, configuration.constraints.stopped_velocity_tolerance, configuration.constraints.goal_time);
  parameters.settle_timeout = host_duration(configuration.settle_timeout);
  parameters.enable_on_start = configuration.enable_on_start;
  return parameters;
}

}  // namespace

class MotionHardware::Implementation {
 public:
  Implementation(const Configuration& configuration, HostTime now);

  void update(HostTime now);
  HostTime next_deadline() const;
  void refresh_handles();
  bool inject(const std::string& target, const std::string& command, std::string* reason);

  HostTime now;
  emulation::World world;
  std::vector<std::unique_ptr<CanLink>> links;
  std::vector<std::unique_ptr<axis::EposAxis>> axes;
  std::vector<emulation::EposDrive*> drives;  ///< one per joint; null where there is none
  std::vector<PathAudit> audits;
  std::optional<motion::Group> group;
  std::vector<JointHandle> handles;
  EventLog log;
  WireObserver wire_observer;
  std::function<void(std::size_t, const emulation::EposSample&)> sample_observer;

 private:
  struct JointValues {
    double position = 0.0;
    double velocity = 0.0;
    double demand = 0.0;
  };

  void add_bus(const BusConfiguration& bus);
  void add_drive(const Configuration& configuration, const DriveConfiguration& drive);
  void take_sample(std::size_t joint, const emulation::EposSample& sample);
  void step(HostTime time);
  void follow_group();
  void begin_audit();
  void log_state_change(motion::GroupState before);
  void log_unexpected_frames();
  CanLink& link(const std::string& name);

  std::map<std::string, BusConfiguration> buses_;
  std::map<std::string, transport::VirtualCanBus*> virtual_buses_;
  std::vector<JointValues> values_;
  motion::GroupState seen_state_ = motion::GroupState::Starting;
  motion::GoalId audited_goal_ = 0;
  std::vector<std::uint64_t> unexpected_;
};

MotionHardware::Implementation::Implementation(const Configuration& configuration, HostTime start)
    : now(start), world(start), values_(configuration.drives.size()) {
  for (const BusConfiguration& bus : configuration.buses) add_bus(bus);
  audits.reserve(configuration.drives.size());
  for (const DriveConfiguration& drive : configuration.drives) add_drive(configuration, drive);
  std::vector<axis::Axis*> members;
  for (const auto& axis : axes) members.push_back(axis.get());
  std::vector<axis::StartSignal*> signals;
  for (const auto& bus : links) signals.push_back(bus.get());
  group.emplace(group_parameters(configuration), std::move(members), std::move(signals), now);
  unexpected_.resize(links.size());
}

void MotionHardware::Implementation::add_bus(const BusConfiguration& bus) {
  virtual_buses_[bus.name] = &world.add_can_bus(bus.name, static_cast<int>(bus.bitrate));
  links.push_back(std::make_unique<CanLink>(bus, world.can_bus(bus.name)));
  buses_[bus.name] = bus;
}

void MotionHardware::Implementation::add_drive(const Configuration& configuration,
                                               const DriveConfiguration& drive) {
  CanLink& bus = link(drive.bus);
  canopen::NodeLink& node = bus.master().add_node(static_cast<std::uint8_t>(drive.node_id));
  axes.push_back(std::make_unique<axis::EposAxis>(
      axis_parameters(configuration, drive, buses_.at(drive.bus), bus.record_bus_time()), bus.master(),
      node));
  const std::size_t index = audits.size();
  audits.emplace_back(drive.transmission);
  handles.push_back(
      {drive.joint, &values_[index].position, &values_[index].velocity, &values_[index].demand});
  drives.push_back(nullptr);
  if (drive.emulation.missing) return;
  drives.back() = &world.add_epos(*virtual_buses_.at(drive.bus), drive.emulation.drive);
  drives.back()->set_sample_observer(
      [this, index](const emulation::EposSample& sample) { take_sample(index, sample); });
}

void MotionHardware::Implementation::take_sample(std::size_t joint, const emulation::EposSample& sample) {
  audits[joint].add(sample);
  if (sample_observer) sample_observer(joint, sample);
}

CanLink& MotionHardware::Implementation::link(const std::string& name) {
  const auto found =
      std::find_if(links.begin(), links.end(), [&name](const auto& l) { return l->name() == name; });
  return **found;
}

// Emulated drives and the driver take turns in the order of virtual time: the driver runs at each frame and
// at each of its own deadlines, at their own time, so a late call of update() changes nothing of what
// happens.
void MotionHardware::Implementation::update(HostTime until) {
  do {
    const HostTime next = std::min(until, std::max(next_deadline(), now + kShortestStep));
    step(world.advance(next));
  } while (now < until);
  refresh_handles();
}

void MotionHardware::Implementation::step(HostTime time) {
  now = time;
  for (const auto& link : links) {
    link->receive(wire_observer);
    link->master().poll(now);
  }
  group->poll(now);
  follow_group();
  for (const auto& link : links) link->send(now);
}

HostTime MotionHardware::Implementation::next_deadline() const {
  HostTime next = group->next_deadline();
  for (const auto& link : links) next = std::min(next, link->master().next_deadline());
  return next;
}

void MotionHardware::Implementation::follow_group() {
  const motion::GroupState state = group->state();
  if (state == seen_state_) return;
  const motion::GroupState before = std::exchange(seen_state_, state);
  if (state == motion::GroupState::Moving) begin_audit();
  if (state != motion::GroupState::Moving && state != motion::GroupState::Settling) {
    for (PathAudit& audit : audits) audit.end();
  }
  log_state_change(before);
}

void MotionHardware::Implementation::begin_audit() {
  const motion::ActiveGoal* goal = group->last_goal();
  for (std::size_t i = 0; i < audits.size(); ++i) audits[i].begin(goal->plan.paths[i]);
  for (const auto& link : links) link->reset_peak_load();
}

void MotionHardware::Implementation::log_state_change(motion::GroupState before) {
  const motion::GroupState state = group->state();
  if (state == motion::GroupState::Fault) {
    log.add(Severity::Error, group->fault());
  } else {
    log.add(Severity::Debug,
            fmt::format("group: {} -> {}", motion::to_string(before), motion::to_string(state)));
  }
  if (before == motion::GroupState::Starting && state != motion::GroupState::Fault) {
    for (const auto& axis : axes) log.add(Severity::Info, axis->description());
  }
  log_unexpected_frames();
}

void MotionHardware::Implementation::log_unexpected_frames() {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::uint64_t count = links[i]->snapshot().unexpected;
    if (count == std::exchange(unexpected_[i], count)) continue;
    for (int cause = 0; cause < canopen::kUnexpectedFrameCauses; ++cause) {
      const std::string text =
          links[i]->master().unexpected_text(static_cast<canopen::UnexpectedFrame>(cause));
      if (!text.empty()) log.add(Severity::Warning, text);
    }
  }
}

void MotionHardware::Implementation::refresh_handles() {
  axis::AxisStatus status;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const axis::AxisFeedback& feedback = axes[i]->feedback();
    axes[i]->status(now, status);
    values_[i] = {feedback.position, feedback.velocity, status.demand_position};
  }
}

bool MotionHardware::Implementation::inject(const std::string& target, const std::string& command,
                                            std::string* reason) {
  if (const auto bus = virtual_buses_.find(target); bus != virtual_buses_.end()) {
    return inject_bus_fault(*bus->second, command, now, reason);
  }
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (handles[i].name == target && drives[i] != nullptr)
      return inject_drive_fault(*drives[i], command, now, reason);
  }
  *reason = fmt::format("\"{}\" is neither a joint with an emulated drive nor an emulated bus", target);
  return false;
}

// ---- the interface
// -------------------------------------------------------------------------------------------------

MotionHardware::MotionHardware(const Configuration& configuration, HostTime now)
    : implementation_(std::make_unique<Implementation>(configuration, now)) {}

MotionHardware::~MotionHardware() = default;

void MotionHardware::read(HostTime now, HostDuration) { implementation_->update(now); }

void MotionHardware::write(HostTime now, HostDuration) { implementation_->update(now); }

void MotionHardware::update(HostTime now) { implementation_->update(now); }

HostTime MotionHardware::next_deadline() const { return implementation_->next_deadline(); }

const std::vector<JointHandle>& MotionHardware::joints() const { return implementation_->handles; }

Expected<motion::GoalAcceptance, Refusal> MotionHardware::submit(const trajectory::Goal& goal, HostTime now) {
  return implementation_->group->submit(goal, now);
}

void MotionHardware::cancel(motion::GoalId goal, HostTime now) { implementation_->group->cancel(goal, now); }

std::optional<motion::GoalResult> MotionHardware::take_goal_result() {
  return implementation_->group->take_goal_result();
}

motion::RequestId MotionHardware::enable(bool on, HostTime now) {
  return implementation_->group->request(on ? motion::RequestKind::Enable : motion::RequestKind::Disable,
                                         now);
}

motion::RequestId MotionHardware::reset_faults(HostTime now) {
  return implementation_->group->request(motion::RequestKind::ResetFaults, now);
}

motion::RequestId MotionHardware::halt(HostTime now) {
  return implementation_->group->request(motion::RequestKind::Halt, now);
}

motion::RequestId MotionHardware::clear_buffers(HostTime now) {
  return implementation_->group->request(motion::RequestKind::ClearBuffers, now);
}

std::optional<motion::RequestResult> MotionHardware::take_request_result() {
  return implementation_->group->take_request_result();
}

void MotionHardware::snapshot(motion::Snapshot& out) const {
  implementation_->group->snapshot(implementation_->now, out);
  out.buses.clear();
  for (const auto& link : implementation_->links) out.buses.push_back(link->snapshot());
}

motion::MotionReport MotionHardware::report() const {
  motion::MotionReport report = implementation_->group->report();
  for (std::size_t i = 0; i < report.joints.size(); ++i) {
    const PathAudit& audit = implementation_->audits[i];
    report.joints[i].samples = audit.samples();
    report.joints[i].worst_deviation = audit.worst_deviation();
    report.joints[i].final_deviation = audit.final_deviation();
  }
  for (const auto& link : implementation_->links)
    report.peak_bus_load.emplace_back(link->name(), link->peak_load());
  return report;
}

bool MotionHardware::query(HostTime time, std::vector<trajectory::State>& out) const {
  return implementation_->group->query(time, out);
}

std::optional<MotionHardware::LogEntry> MotionHardware::take_log() { return implementation_->log.take(); }

void MotionHardware::set_wire_observer(WireObserver observer) {
  implementation_->wire_observer = std::move(observer);
}

void MotionHardware::set_sample_observer(
    std::function<void(std::size_t, const emulation::EposSample&)> observer) {
  implementation_->sample_observer = std::move(observer);
}

bool MotionHardware::inject(const std::string& target, const std::string& command, std::string* reason,
                            HostTime) {
  return implementation_->inject(target, command, reason);
}

}  // namespace interpolated_motion::hardware
