#include "interpolated_motion_driver/hardware/motion_hardware.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/hardware/assembly.h"
#include "interpolated_motion_driver/hardware/group_parameters.h"
#include "interpolated_motion_driver/hardware/recorder_tap.h"
#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::hardware {

namespace {

/// Shortest step of the loop: deadlines that lie closer together are served together.
constexpr HostDuration kShortestStep = std::chrono::microseconds(50);

}  // namespace

class MotionHardware::Implementation {
 public:
  Implementation(const Configuration& configuration, HostTime now, EventLoop loop);

  void update(HostTime now);
  HostTime next_deadline() const;
  void refresh_handles();
  std::optional<Refusal> take_commands(HostTime time);
  motion::RequestId request(motion::RequestKind kind, HostTime time);

  HostTime now;
  Assembly assembly;
  std::optional<motion::Group> group;
  std::optional<GoalDesk> desk;
  std::vector<JointHandle> handles;
  EventLog log;
  RecorderTap tap;

 private:
  struct JointValues {
    double position = 0.0;
    double velocity = 0.0;
    double demand = 0.0;
    double command = std::numeric_limits<double>::quiet_NaN();
  };

  void step(HostTime time);
  void take_notes();
  void follow_group();
  void follow_course();
  void log_state_change(motion::GroupState before);
  void log_unexpected_traffic();

  std::vector<JointValues> values_;
  axis::AxisStatus status_;  ///< scratch
  HostDuration write_period_;
  HostTime commands_due_ = HostTime::min();
  std::uint64_t seen_motion_ = 0;
  std::uint64_t seen_revision_ = 0;
  motion::GroupState seen_state_ = motion::GroupState::Starting;
  std::vector<std::uint64_t> unexpected_;
};

MotionHardware::Implementation::Implementation(const Configuration& configuration, HostTime start,
                                               EventLoop loop)
    : now(start),
      assembly(configuration, start, std::move(loop)),
      tap(configuration, start),
      values_(configuration.drives.size()),
      write_period_(host_duration(configuration.setpoints.write_period.count())),
      unexpected_(assembly.links().size()) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    handles.push_back({configuration.drives[i].joint, &values_[i].position, &values_[i].velocity,
                       &values_[i].demand, &values_[i].command});
  }
  std::vector<axis::Axis*> members;
  for (const auto& axis : assembly.axes()) members.push_back(axis.get());
  std::vector<axis::StartSignal*> signals;
  for (const auto& link : assembly.links()) signals.push_back(link.get());
  log.set_observer([this](const LogEntry& entry) { tap.log(now, entry); });
  group.emplace(group_parameters(configuration), std::move(members), std::move(signals), now);
  desk.emplace(*group);
}

// Emulated drives and the driver take turns in the order of virtual time: the driver runs at each frame and
// at each of its own deadlines, at their own time, so a late call of update() changes nothing of what
// happens.
void MotionHardware::Implementation::update(HostTime until) {
  if (assembly.emulates()) {
    do {
      const HostTime next = std::min(until, std::max(next_deadline(), now + kShortestStep));
      step(assembly.world().advance(next));
    } while (now < until);
  } else {
    tap.note_call(std::max(now, next_deadline()), until);
    step(until);
  }
}

void MotionHardware::Implementation::step(HostTime time) {
  now = time;
  for (const auto& link : assembly.links()) {
    link->receive(tap.wire());
    link->follow_device(now, log);
    link->poll(now);
  }
  group->poll(now);
  desk->poll(now);
  take_notes();
  follow_group();
  tap.look(now, *group, assembly.links());
  for (const auto& link : assembly.links()) link->send(now);
}

HostTime MotionHardware::Implementation::next_deadline() const {
  HostTime next = std::min(group->next_deadline(), desk->next_deadline());
  for (const auto& link : assembly.links()) next = std::min(next, link->next_deadline());
  return next;
}

void MotionHardware::Implementation::take_notes() {
  for (const auto& axis : assembly.axes()) {
    while (auto note = axis->take_note())
      log.add(note->is_problem ? Severity::Warning : Severity::Info, std::move(note->text));
  }
  while (auto note = group->take_note()) log.add(Severity::Warning, std::move(*note));
}

void MotionHardware::Implementation::follow_group() {
  follow_course();
  const motion::GroupState state = group->state();
  if (state == seen_state_) return;
  const motion::GroupState before = std::exchange(seen_state_, state);
  tap.follow(now, before, *group);
  if (state == motion::GroupState::Idle || state == motion::GroupState::Stopping ||
      state == motion::GroupState::Fault)
    assembly.end_audits(now);
  log_state_change(before);
}

void MotionHardware::Implementation::follow_course() {
  const motion::Course& course = group->course();
  const bool begins = course.motion() != std::exchange(seen_motion_, course.motion());
  if (course.revision() == std::exchange(seen_revision_, course.revision())) return;
  if (begins) {
    assembly.begin_audits(course.paths(), now);
    for (const auto& link : assembly.links()) link->reset_peak_load();
    return;
  }
  for (std::size_t i = 0; i < values_.size(); ++i) assembly.audits()[i].follow(course.paths()[i]);
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
    for (const auto& axis : assembly.axes()) log.add(Severity::Info, axis->description());
  }
  log_unexpected_traffic();
}

void MotionHardware::Implementation::log_unexpected_traffic() {
  for (std::size_t i = 0; i < unexpected_.size(); ++i) {
    const BusLink& link = *assembly.links()[i];
    const std::uint64_t count = link.unexpected();
    if (count == std::exchange(unexpected_[i], count)) continue;
    for (std::string& text : link.unexpected_traffic()) log.add(Severity::Warning, std::move(text));
  }
}

void MotionHardware::Implementation::refresh_handles() {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const axis::Axis& axis = *assembly.axes()[i];
    const axis::AxisFeedback& feedback = axis.feedback();
    axis.status(now, status_);
    values_[i].position = feedback.position;
    values_[i].velocity = feedback.velocity;
    values_[i].demand = status_.demand_position;
  }
}

std::optional<Refusal> MotionHardware::Implementation::take_commands(HostTime time) {
  if (time < commands_due_) return std::nullopt;
  const auto is_free = [](const JointValues& joint) { return std::isnan(joint.command); };
  if (std::all_of(values_.begin(), values_.end(), is_free)) return std::nullopt;
  commands_due_ = time + write_period_;
  motion::Setpoint setpoint;
  setpoint.time = time;
  setpoint.source = "write()";
  for (std::size_t i = 0; i < values_.size(); ++i) {
    setpoint.joint_names.push_back(handles[i].name);
    setpoint.positions.push_back(values_[i].command);
  }
  auto refusal = group->setpoint(setpoint, time);
  tap.recorder().setpoint(time, setpoint, refusal);
  return refusal;
}

motion::RequestId MotionHardware::Implementation::request(motion::RequestKind kind, HostTime time) {
  const motion::RequestId id = group->request(kind, time);
  tap.request(time, kind, id);
  return id;
}

// The interface.

MotionHardware::MotionHardware(const Configuration& configuration, HostTime now, EventLoop loop)
    : implementation_(std::make_unique<Implementation>(configuration, now, std::move(loop))) {}

MotionHardware::~MotionHardware() = default;

void MotionHardware::read(HostTime now, HostDuration) {
  implementation_->update(now);
  implementation_->refresh_handles();
}

std::optional<Refusal> MotionHardware::write(HostTime now, HostDuration) {
  auto refusal = implementation_->take_commands(now);
  implementation_->update(now);
  return refusal;
}

void MotionHardware::update(HostTime now) { implementation_->update(now); }

void MotionHardware::stall(HostTime until) {
  if (implementation_->assembly.emulates() && implementation_->now < until)
    implementation_->tap.recorder().absence(implementation_->now, until);
  while (implementation_->assembly.emulates() && implementation_->now < until)
    implementation_->now = implementation_->assembly.world().advance(until);
}

HostTime MotionHardware::next_deadline() const { return implementation_->next_deadline(); }

const std::vector<JointHandle>& MotionHardware::joints() const { return implementation_->handles; }

Expected<motion::GoalAcceptance, Refusal> MotionHardware::submit(const trajectory::Goal& goal, HostTime now) {
  auto answer = implementation_->group->submit(goal, now);
  implementation_->tap.recorder().goal(now, std::make_shared<const trajectory::Goal>(goal), answer);
  return answer;
}

Ticket MotionHardware::submit_later(motion::GoalPtr goal, HostTime now) {
  return implementation_->desk->submit(std::move(goal), now);
}

void MotionHardware::withdraw(Ticket ticket, HostTime) { implementation_->desk->withdraw(ticket); }

std::optional<GoalAnswer> MotionHardware::take_goal_answer() {
  auto answer = implementation_->desk->take_answer();
  if (answer) implementation_->tap.recorder().goal(implementation_->now, answer->goal, answer->answer);
  return answer;
}

void MotionHardware::set_planner(Planner planner) { implementation_->desk->set_planner(std::move(planner)); }

void MotionHardware::planned(const motion::Planning& planning, HostDuration taken, HostTime now) {
  implementation_->desk->planned(planning, taken, now);
}

void MotionHardware::set_planning_time(HostDuration time) { implementation_->desk->set_planning_time(time); }

void MotionHardware::cancel(motion::GoalId goal, HostTime now) {
  implementation_->tap.recorder().order(now, "cancel", fmt::format("goal: {}", goal));
  implementation_->group->cancel(goal, now);
}

std::optional<motion::GoalResult> MotionHardware::take_goal_result() {
  auto result = implementation_->group->take_goal_result();
  if (result) implementation_->tap.recorder().ended(implementation_->now, *result);
  return result;
}

std::optional<Refusal> MotionHardware::order_speed(const motion::SpeedOrder& order, HostTime now) {
  implementation_->tap.speed(now, order);
  return implementation_->group->order_speed(order, now);
}

std::optional<Refusal> MotionHardware::setpoint(const motion::Setpoint& setpoint, HostTime now) {
  auto refusal = implementation_->group->setpoint(setpoint, now);
  implementation_->tap.recorder().setpoint(now, setpoint, refusal);
  return refusal;
}

motion::RequestId MotionHardware::enable(bool on, HostTime now) {
  return implementation_->request(on ? motion::RequestKind::Enable : motion::RequestKind::Disable, now);
}

motion::RequestId MotionHardware::shut_down(HostTime now) {
  return implementation_->request(motion::RequestKind::ShutDown, now);
}

motion::RequestId MotionHardware::reset_faults(HostTime now) {
  return implementation_->request(motion::RequestKind::ResetFaults, now);
}

motion::RequestId MotionHardware::halt(HostTime now) {
  return implementation_->request(motion::RequestKind::Halt, now);
}

motion::RequestId MotionHardware::clear_buffers(HostTime now) {
  return implementation_->request(motion::RequestKind::ClearBuffers, now);
}

std::optional<motion::RequestResult> MotionHardware::take_request_result() {
  auto result = implementation_->group->take_request_result();
  if (result) implementation_->tap.recorder().ended(implementation_->now, *result);
  return result;
}

void MotionHardware::snapshot(motion::Snapshot& out) const {
  take_snapshot(implementation_->now, *implementation_->group, implementation_->assembly.links(), out);
}

motion::MotionReport MotionHardware::report() const {
  motion::MotionReport report = implementation_->group->report();
  for (std::size_t i = 0; i < report.joints.size(); ++i) {
    const PathAudit& audit = implementation_->assembly.audits()[i];
    report.joints[i].samples = audit.samples();
    report.joints[i].worst_deviation = audit.worst_deviation();
    report.joints[i].final_deviation = audit.final_deviation();
    report.joints[i].count = audit.count();
  }
  for (const auto& link : implementation_->assembly.links())
    report.peak_bus_load.emplace_back(link->name(), link->peak_load());
  return report;
}

bool MotionHardware::query(HostTime time, std::vector<trajectory::State>& out) const {
  return implementation_->group->query(time, out) || implementation_->tap.history().at(time, out);
}

std::optional<MotionHardware::LogEntry> MotionHardware::take_log() { return implementation_->log.take(); }

void MotionHardware::forget_samples(std::size_t joint) {
  implementation_->assembly.audits().at(joint).clear();
}

void MotionHardware::add_sample(std::size_t joint, const DemandSample& sample) {
  implementation_->assembly.audits().at(joint).add(sample);
}

void MotionHardware::set_wire_observer(WireObserver observer) {
  implementation_->tap.set_observer(std::move(observer));
}

recording::Recording MotionHardware::recording() const {
  return implementation_->tap.recorder().recording(implementation_->now);
}

void MotionHardware::set_motion_observer(SampleObserver observer) {
  implementation_->assembly.set_motion_observer(std::move(observer));
}

void MotionHardware::set_sample_observer(SampleObserver observer) {
  implementation_->assembly.set_sample_observer(std::move(observer));
}

std::optional<double> MotionHardware::emulated_position(std::size_t joint) const {
  return implementation_->assembly.emulated_position(joint);
}

std::optional<bool> MotionHardware::emulated_power(std::size_t joint) const {
  return implementation_->assembly.emulated_power(joint);
}

bool MotionHardware::inject(const std::string& target, const std::string& command, std::string* reason,
                            HostTime) {
  auto refused = implementation_->assembly.inject(target, command, implementation_->now);
  implementation_->tap.recorder().order(
      implementation_->now, "inject",
      fmt::format("target: {}, command: {}, answer: {}", recording::in_quotes(target),
                  recording::in_quotes(command),
                  recording::in_quotes(refused ? "refused: " + *refused : "accepted")));
  if (refused) *reason = std::move(*refused);
  return !refused;
}

}  // namespace interpolated_motion::hardware
