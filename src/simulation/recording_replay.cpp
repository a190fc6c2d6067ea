#include "simulation/recording_replay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "interpolated_motion_driver/recording/recording.h"
#include "interpolated_motion_driver/recording/yaml_text.h"

namespace interpolated_motion::simulation {

namespace {

using motion::GroupState;
using recording::RecordedOrder;
using recording::RecordingFile;

constexpr HostDuration kLook = std::chrono::milliseconds(5);
/// After bring-up, until the first order.
constexpr HostDuration kRest = std::chrono::milliseconds(100);
/// For drives to be found, enabled and disabled, where the configuration does not allow more.
constexpr double kBringUp = 5.0;

/// Drives of other processes and places are emulated here.
void emulate_all(hardware::Configuration& configuration) {
  for (hardware::BusConfiguration& bus : configuration.buses)
    bus.transport = hardware::TransportKind::Emulated;
}

/// How late the driver may see a fault of a drive: at the next SYNC or status.
HostDuration poll_of(const hardware::Configuration& configuration) {
  double longest = 0.0;
  for (const hardware::BusConfiguration& bus : configuration.buses)
    longest = std::max(longest,
                       bus.type == hardware::BusType::Canopen ? bus.sync_period : bus.serial.status_period);
  return host_duration(longest) + kLook;
}

void place_joints(hardware::Configuration& configuration, const std::vector<std::string>& joints,
                  const YAML::Node& positions) {
  for (hardware::DriveConfiguration& drive : configuration.drives) {
    const auto i =
        static_cast<std::size_t>(std::find(joints.begin(), joints.end(), drive.joint) - joints.begin());
    if (i >= positions.size()) continue;
    drive.emulation.initial_position =
        static_cast<std::int32_t>(std::lround(drive.transmission.counts(positions[i].as<double>())));
  }
}

motion::Setpoint setpoint_of(const YAML::Node& arguments, HostDuration shift) {
  motion::Setpoint setpoint;
  setpoint.time = recording::parse_time(arguments["time"].as<std::string>()) + shift;
  setpoint.joint_names = arguments["joint_names"].as<std::vector<std::string>>();
  setpoint.positions = arguments["positions"].as<std::vector<double>>();
  if (arguments["velocities"]) setpoint.velocities = arguments["velocities"].as<std::vector<double>>();
  setpoint.source = arguments["source"].as<std::string>("recording");
  return setpoint;
}

class Replay {
 public:
  Replay(const RecordingFile& file, std::function<void(HostTime, const std::string&)> tell)
      : file_(file), tell_(std::move(tell)) {}

  Replayed run();

 private:
  void start();
  void start_in_the_middle();
  bool run_until(const std::function<bool(GroupState)>& is_reached, double seconds);
  void advance_to(HostTime time);
  void look();
  void find_recorded_fault();
  void note_fault();
  void carry_out(const RecordedOrder& order);
  bool obey(const RecordedOrder& order);
  bool submit(const YAML::Node& arguments);
  void request(const std::string& verb);
  void say(const std::string& line) {
    if (tell_) tell_(now_ - shift_, line);
  }

  const RecordingFile& file_;
  const std::function<void(HostTime, const std::string&)> tell_;
  hardware::Configuration configuration_;
  std::unique_ptr<hardware::MotionHardware> driver_;
  HostTime now_{};
  HostDuration shift_{0};  ///< of this driver's clock against the recording's
  motion::Snapshot snapshot_;
  GroupState state_ = GroupState::Starting;
  std::map<motion::GoalId, motion::GoalId> goals_;  ///< of this driver, by the recording's
  Replayed outcome_;
};

Replayed Replay::run() {
  configuration_ = hardware::parse_configuration(file_.configuration, file_.limits);
  emulate_all(configuration_);
  outcome_.poll = poll_of(configuration_);
  start();
  find_recorded_fault();
  for (const RecordedOrder& order : file_.orders) {
    advance_to(order.time + shift_);
    carry_out(order);
  }
  advance_to(file_.end + shift_);
  return std::move(outcome_);
}

void Replay::start() {
  if (!file_.complete && !file_.orders.empty()) return start_in_the_middle();
  now_ = file_.begin;
  driver_ = std::make_unique<hardware::MotionHardware>(configuration_, now_);
}

void Replay::start_in_the_middle() {
  const RecordedOrder& first = file_.orders.front();
  if (first.verb == "setpoint") {
    place_joints(configuration_, first.arguments["joint_names"].as<std::vector<std::string>>(),
                 first.arguments["positions"]);
  } else {
    place_joints(configuration_, configuration_.joints, first.arguments["positions"]);
  }
  const bool disabled = first.arguments["group"].as<std::string>("idle") == "disabled";
  configuration_.enable_on_start = !disabled;
  driver_ = std::make_unique<hardware::MotionHardware>(configuration_, now_);
  const GroupState wanted = disabled ? GroupState::Disabled : GroupState::Idle;
  if (!run_until([wanted](GroupState state) { return state == wanted; },
                 configuration_.bring_up_timeout + kBringUp))
    throw std::runtime_error(fmt::format("the emulated drives are not {} before the first order: {} {}",
                                         motion::to_string(wanted), motion::to_string(state_),
                                         snapshot_.fault));
  advance_to(now_ + kRest);
  shift_ = now_ - first.time;
}

bool Replay::run_until(const std::function<bool(GroupState)>& is_reached, double patience) {
  const HostTime end = now_ + host_duration(patience);
  while (!is_reached(state_) && now_ < end) advance_to(now_ + kLook);
  return is_reached(state_);
}

void Replay::advance_to(HostTime time) {
  while (now_ < time) {
    now_ = std::min(time, now_ + kLook);
    driver_->update(now_);
    look();
  }
}

void Replay::look() {
  driver_->snapshot(snapshot_);
  while (const auto entry = driver_->take_log()) say("log: " + entry->text);
  while (const auto result = driver_->take_goal_result())
    say(fmt::format("goal {} has ended: {}", result->id, result->text));
  while (const auto result = driver_->take_request_result())
    say(fmt::format("request {} {}: {}", result->id, result->success ? "done" : "failed", result->message));
  const GroupState before = std::exchange(state_, snapshot_.state);
  if (state_ == before) return;
  say(fmt::format("group: {} -> {}", motion::to_string(before), motion::to_string(state_)));
  if (state_ == GroupState::Fault && !outcome_.replayed) note_fault();
}

/// The driver's own recording knows to the nanosecond when it was.
void Replay::note_fault() {
  const RecordingFile own = recording::parse_recording(recording::to_text(driver_->recording(), "replay"));
  if (own.faults.empty()) return;
  outcome_.replayed = own.faults.back();
  outcome_.replayed->time -= shift_;
}

void Replay::find_recorded_fault() {
  const HostTime first = file_.complete || file_.orders.empty() ? file_.begin : file_.orders.front().time;
  for (const recording::RecordedFault& fault : file_.faults)
    if (!outcome_.recorded && fault.time >= first) outcome_.recorded = fault;
}

void Replay::carry_out(const RecordedOrder& order) {
  ++outcome_.orders;
  const bool was_accepted = order.arguments["answer"].as<std::string>("accepted") == "accepted";
  const bool is_accepted = obey(order);
  if (was_accepted != is_accepted) ++outcome_.answered_otherwise;
  say(fmt::format("> {}{}", order.verb,
                  was_accepted == is_accepted ? "" : ", answered otherwise than recorded"));
}

bool Replay::obey(const RecordedOrder& order) {
  const YAML::Node& arguments = order.arguments;
  if (order.verb == "goal") return submit(arguments);
  if (order.verb == "setpoint") return !driver_->setpoint(setpoint_of(arguments, shift_), now_);
  if (order.verb == "inject") {
    std::string reason;
    return driver_->inject(arguments["target"].as<std::string>(), arguments["command"].as<std::string>(),
                           &reason, now_);
  }
  if (order.verb == "speed") {
    motion::SpeedOrder speed;
    if (arguments["override"]) speed.override_rate = arguments["override"].as<double>();
    if (arguments["paused"]) speed.paused = arguments["paused"].as<bool>();
    driver_->order_speed(speed, now_);
  } else if (order.verb == "cancel") {
    driver_->cancel(goals_[arguments["goal"].as<motion::GoalId>()], now_);
  } else if (order.verb == "absence") {
    const HostTime until = recording::parse_time(arguments["until"].as<std::string>()) + shift_;
    driver_->stall(until);
    now_ = std::max(now_, until);
  } else {
    request(order.verb);
  }
  return true;
}

bool Replay::submit(const YAML::Node& arguments) {
  trajectory::Goal goal = recording::parse_goal(arguments);
  if (goal.start) *goal.start += shift_;
  const auto answer = driver_->submit(goal, now_);
  if (answer) goals_[arguments["id"].as<motion::GoalId>()] = answer.value().id;
  if (!answer) say("refused: " + answer.error().text);
  return static_cast<bool>(answer);
}

void Replay::request(const std::string& verb) {
  if (verb == "enable" || verb == "disable") {
    driver_->enable(verb == "enable", now_);
  } else if (verb == "shut_down") {
    driver_->shut_down(now_);
  } else if (verb == "reset") {
    driver_->reset_faults(now_);
  } else if (verb == "halt") {
    driver_->halt(now_);
  } else if (verb == "clear") {
    driver_->clear_buffers(now_);
  } else {
    throw std::invalid_argument(fmt::format("the recording has an order \"{}\", which is unknown", verb));
  }
}

}  // namespace

bool Replayed::is_same() const {
  if (!recorded || !replayed) return !recorded && !replayed;
  const HostDuration off = replayed->time - recorded->time;
  return recorded->text == replayed->text && off <= poll && off >= -poll;
}

Replayed replay(const RecordingFile& file, const std::function<void(HostTime, const std::string&)>& tell) {
  return Replay(file, tell).run();
}

}  // namespace interpolated_motion::simulation
