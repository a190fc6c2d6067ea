#include "interpolated_motion_driver/recording/flight_recorder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "interpolated_motion_driver/recording/entry_flags.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::recording {

namespace {

std::size_t ring_bytes(const RecorderSettings& settings) { return settings.bytes - settings.bytes / 4; }

const char* name_of(motion::GoalOutcome outcome) {
  switch (outcome) {
    case motion::GoalOutcome::Succeeded:
      return "succeeded";
    case motion::GoalOutcome::Preempted:
      return "preempted";
    case motion::GoalOutcome::Aborted:
      break;
  }
  return "aborted";
}

template <class Value>
void append(std::vector<char>& bytes, const Value& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

void append(std::vector<char>& bytes, const std::vector<double>& values) {
  for (const double value : values) append(bytes, value);
}

}  // namespace

FlightRecorder::FlightRecorder(const RecorderSettings& settings, Subject subject, HostTime start)
    : settings_(settings),
      subject_(std::move(subject)),
      start_(start),
      ring_(ring_bytes(settings)),
      orders_(settings.bytes / 4),
      positions_(subject_.joints.size()),
      drives_(subject_.joints.size()),
      buses_(subject_.buses.size()) {}

void FlightRecorder::push(EntryHead head, const void* bytes) {
  ring_.forget_before(head.time - settings_.window);
  ring_.push(head, bytes);
}

std::uint8_t FlightRecorder::bus_number(const std::string& bus) const {
  const auto found = std::find(subject_.buses.begin(), subject_.buses.end(), bus);
  return static_cast<std::uint8_t>(found - subject_.buses.begin());
}

void FlightRecorder::frame(const std::string& bus, const canopen::ReceivedFrame& received) {
  const canopen::Frame& frame = received.frame;
  std::array<std::uint8_t, sizeof frame.id + sizeof frame.data> bytes{};
  std::memcpy(bytes.data(), &frame.id, sizeof frame.id);
  std::memcpy(bytes.data() + sizeof frame.id, frame.data.data(), sizeof frame.data);
  const std::size_t length = std::min<std::size_t>(frame.length, frame.data.size());
  EntryHead head{received.time, static_cast<std::uint32_t>(sizeof frame.id + length), EntryKind::Frame};
  head.source = bus_number(bus);
  head.flags = static_cast<std::uint8_t>((received.own ? kOwn : 0) | (frame.extended ? kExtended : 0) |
                                         (frame.remote ? kRemote : 0));
  head.detail = frame.length;
  push(head, bytes.data());
}

void FlightRecorder::line(const std::string& bus, std::string_view text, HostTime time, bool from_host) {
  text = text.substr(0, kLongestLine);
  EntryHead head{time, static_cast<std::uint32_t>(text.size()), EntryKind::Line};
  head.source = bus_number(bus);
  head.flags = from_host ? kOwn : 0;
  push(head, text.data());
}

// An entry: time, number of joints; their numbers; positions, velocities; whose, or why refused.
void FlightRecorder::setpoint(HostTime now, const motion::Setpoint& setpoint,
                              const std::optional<Refusal>& refusal) {
  scratch_.clear();
  append(scratch_, setpoint.time);
  const std::size_t values = std::min<std::size_t>(setpoint.positions.size(), 255);
  for (std::size_t i = 0; i < values; ++i) {
    const auto& joints = subject_.joints;
    const auto found = i < setpoint.joint_names.size()
                           ? std::find(joints.begin(), joints.end(), setpoint.joint_names[i])
                           : joints.end();
    append(scratch_, static_cast<std::uint8_t>(found - joints.begin()));
  }
  const bool has_velocities = setpoint.velocities.size() == setpoint.positions.size() && values > 0;
  for (std::size_t i = 0; i < values; ++i) append(scratch_, setpoint.positions[i]);
  if (has_velocities) append(scratch_, setpoint.velocities);
  const std::string_view text = std::string_view(refusal ? refusal->text : setpoint.source);
  scratch_.insert(scratch_.end(), text.begin(), text.begin() + std::min(text.size(), kLongestNote));
  EntryHead head{now, static_cast<std::uint32_t>(scratch_.size()), EntryKind::Setpoint};
  head.flags = static_cast<std::uint8_t>((has_velocities ? kHasVelocities : 0) | (refusal ? kIsRefused : 0));
  head.detail = static_cast<std::uint8_t>(values);
  push(head, scratch_.data());
}

std::string FlightRecorder::where() const {
  return fmt::format("group: {}, positions: {}", motion::to_string(state_), list(positions_));
}

void FlightRecorder::goal(HostTime now, const std::shared_ptr<const trajectory::Goal>& goal,
                          const Expected<motion::GoalAcceptance, Refusal>& answer) {
  Order order;
  order.time = now;
  order.verb = "goal";
  order.goal = goal;
  order.id = answer ? answer.value().id : 0;
  order.arguments = fmt::format("id: {}, {}, answer: {}", order.id, where(),
                                in_quotes(answer ? "accepted" : "refused: " + answer.error().text));
  orders_.forget_before(now - settings_.window);
  orders_.add(std::move(order));
}

void FlightRecorder::order(HostTime now, std::string_view verb, std::string arguments) {
  Order order;
  order.time = now;
  order.verb = verb;
  order.arguments = std::move(arguments);
  if (!order.arguments.empty()) order.arguments += ", ";
  order.arguments += where();
  orders_.forget_before(now - settings_.window);
  orders_.add(std::move(order));
}

void FlightRecorder::absence(HostTime from, HostTime until) {
  Order* newest = orders_.newest();
  const bool goes_on = newest != nullptr && newest->verb == "absence" && absent_until_ == from;
  absent_until_ = until;
  if (!goes_on) return order(from, "absence", "until: " + time_text(until));
  newest->arguments = "until: " + time_text(until) + newest->arguments.substr(newest->arguments.find(','));
}

void FlightRecorder::ended(HostTime now, const motion::GoalResult& result) {
  orders_.end(result.id, now);
  const bool aborted = result.outcome == motion::GoalOutcome::Aborted;
  note(now, NoteKind::End,
       fmt::format("goal {} {}{}: {}", result.id, name_of(result.outcome),
                   aborted ? fmt::format(" {}", static_cast<int>(result.code)) : "", result.text));
}

void FlightRecorder::ended(HostTime now, const motion::RequestResult& result) {
  note(now, NoteKind::End,
       fmt::format("request {} {}: {}", result.id, result.success ? "done" : "failed", result.message));
}

void FlightRecorder::group(HostTime now, motion::GroupState before, motion::GroupState state,
                           std::string_view fault) {
  state_ = state;
  note(now, NoteKind::Group,
       fmt::format("{} -> {}{}{}", motion::to_string(before), motion::to_string(state),
                   fault.empty() ? "" : ": ", fault));
}

void FlightRecorder::log(HostTime now, std::string_view severity, std::string_view text) {
  note(now, NoteKind::Log, fmt::format("{}: {}", severity, text));
}

void FlightRecorder::note(HostTime now, NoteKind kind, std::string_view text) {
  text = text.substr(0, kLongestNote);
  EntryHead head{now, static_cast<std::uint32_t>(text.size()), EntryKind::Note};
  head.detail = static_cast<std::uint8_t>(kind);
  push(head, text.data());
}

void FlightRecorder::look(const motion::Snapshot& snapshot) {
  const std::size_t joints = std::min(drives_.size(), snapshot.joints.size());
  for (std::size_t i = 0; i < joints; ++i) look_at_joint(snapshot.time, i, snapshot.joints[i]);
  const std::size_t buses = std::min(buses_.size(), snapshot.buses.size());
  for (std::size_t i = 0; i < buses; ++i) look_at_bus(snapshot.time, i, snapshot.buses[i]);
}

void FlightRecorder::look_at_joint(HostTime now, std::size_t index, const motion::JointSnapshot& joint) {
  const JointSample sample{joint.desired.position, joint.desired.velocity, joint.actual.position,
                           joint.actual.velocity,  joint.demand_position,  joint.fill_time};
  EntryHead head{now, sizeof sample, EntryKind::Joint};
  head.source = static_cast<std::uint8_t>(index);
  push(head, &sample);
  positions_[index] = joint.actual.position;
  Seen& seen = drives_[index];
  if (seen.online == joint.online && seen.statusword == joint.statusword &&
      seen.error_code == joint.error_code && seen.state == joint.state)
    return;
  seen = {joint.online, joint.statusword, joint.error_code, joint.state};
  note(now, NoteKind::Drive,
       fmt::format("{} {}, {}, statusword 0x{:04X}, mode {}, error 0x{:04X}{}{}", joint.joint,
                   joint.online ? "online" : "offline", joint.state, joint.statusword, joint.mode,
                   joint.error_code, joint.error_text.empty() ? "" : ": ", joint.error_text));
}

void FlightRecorder::look_at_bus(HostTime now, std::size_t index, const motion::BusSnapshot& bus) {
  Seen& seen = buses_[index];
  if (seen.online == bus.usable && seen.state == bus.state) return;
  seen.online = bus.usable;
  seen.state = bus.state;
  note(now, NoteKind::Bus,
       fmt::format("{} {}: {}", bus.name, bus.usable ? "usable" : "not usable", bus.state));
}

Recording FlightRecorder::recording(HostTime now) const {
  Recording copy;
  copy.subject = subject_;
  copy.end = now;
  copy.complete = ring_.forgotten() + ring_.displaced() + orders_.forgotten() + orders_.left_out() == 0;
  copy.begin = copy.complete ? start_ : std::max(start_, now - settings_.window);
  copy.displaced = ring_.displaced();
  copy.orders_left_out = orders_.left_out();
  copy.entries = ring_.copy();
  copy.orders.assign(orders_.orders().begin(), orders_.orders().end());
  return copy;
}

}  // namespace interpolated_motion::recording
