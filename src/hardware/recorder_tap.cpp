#include "interpolated_motion_driver/hardware/recorder_tap.h"

#include <cstddef>

#include <fmt/format.h>

namespace interpolated_motion::hardware {

namespace {

constexpr HostDuration kLookPeriod = std::chrono::milliseconds(20);
/// A host that is so late is told: more than the driver's own loop sleeps, less than what any drive bridges.
constexpr HostDuration kLate = std::chrono::milliseconds(50);
constexpr double kMegabyte = 1048576.0;

recording::RecorderSettings settings_of(const RecorderConfiguration& configuration) {
  return {host_duration(configuration.seconds),
          static_cast<std::size_t>(configuration.megabytes * kMegabyte)};
}

recording::Subject subject_of(const Configuration& configuration) {
  recording::Subject subject{configuration.source, configuration.urdf, configuration.joints, {}};
  for (const BusConfiguration& bus : configuration.buses) subject.buses.push_back(bus.name);
  return subject;
}

const char* name_of(Severity severity) {
  switch (severity) {
    case Severity::Debug:
      return "debug";
    case Severity::Info:
      return "info";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      break;
  }
  return "error";
}

/// As a recording calls it.
const char* verb_of(motion::RequestKind kind) {
  switch (kind) {
    case motion::RequestKind::Enable:
      return "enable";
    case motion::RequestKind::Disable:
      return "disable";
    case motion::RequestKind::ShutDown:
      return "shut_down";
    case motion::RequestKind::ResetFaults:
      return "reset";
    case motion::RequestKind::Halt:
      return "halt";
    case motion::RequestKind::ClearBuffers:
      break;
  }
  return "clear";
}

}  // namespace

RecorderTap::RecorderTap(const Configuration& configuration, HostTime start)
    : recorder_(settings_of(configuration.flight_recorder), subject_of(configuration), start),
      history_(configuration.joints.size()) {
  wire_.frame = [this](const std::string& bus, const canopen::ReceivedFrame& frame) {
    recorder_.frame(bus, frame);
    if (observer_.frame) observer_.frame(bus, frame);
  };
  wire_.text = [this](const std::string& bus, const SerialText& text) {
    recorder_.line(bus, text.text, text.time, text.from_host);
    if (observer_.text) observer_.text(bus, text);
  };
}

void RecorderTap::request(HostTime now, motion::RequestKind kind, motion::RequestId id) {
  recorder_.order(now, verb_of(kind), fmt::format("request: {}", id));
}

void RecorderTap::speed(HostTime now, const motion::SpeedOrder& order) {
  std::string arguments;
  if (order.override_rate) arguments = fmt::format("override: {}", *order.override_rate);
  if (order.paused) arguments += fmt::format("{}paused: {}", arguments.empty() ? "" : ", ", *order.paused);
  recorder_.order(now, "speed", std::move(arguments));
}

void RecorderTap::look(HostTime now, const motion::Group& group,
                       const std::vector<std::unique_ptr<BusLink>>& links) {
  if (now < next_look_) return;
  next_look_ = now + kLookPeriod;
  take_snapshot(now, group, links, snapshot_);
  recorder_.look(snapshot_);
  note_desired(now, group);
}

/// Of drives that nobody holds: what they do.
void RecorderTap::note_desired(HostTime now, const motion::Group& group) {
  if (!group.query(now, desired_)) {
    desired_.clear();
    for (const motion::JointSnapshot& joint : snapshot_.joints) desired_.push_back(joint.desired);
  }
  history_.add(now, desired_);
}

void RecorderTap::follow(HostTime now, motion::GroupState before, const motion::Group& group) {
  recorder_.group(now, before, group.state(), group.fault());
  next_look_ = now;
}

void RecorderTap::log(HostTime now, const LogEntry& entry) {
  recorder_.log(now, name_of(entry.severity), entry.text);
}

void RecorderTap::note_call(HostTime due, HostTime now) {
  if (now - kLate > due) recorder_.absence(due, now);  // due may be kNever
}

void take_snapshot(HostTime now, const motion::Group& group,
                   const std::vector<std::unique_ptr<BusLink>>& links, motion::Snapshot& out) {
  group.snapshot(now, out);
  out.buses.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) links[i]->snapshot(out.buses[i]);
}

}  // namespace interpolated_motion::hardware
