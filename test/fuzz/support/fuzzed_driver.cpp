#include "fuzz/support/fuzzed_driver.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "fuzz/support/require.h"
#include "simulation/known_faults.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr HostDuration kLook = std::chrono::milliseconds(5);
constexpr double kBringUp = 3.0;  // s: boot within one second, and `bring_up_timeout`
/// s: what an order may take, whatever has become of the drives: braking, several time-outs of each drive.
constexpr double kPatience = 20.0;
/// Lines of log: as many as the simulation allows a second (docs/simulation.md), over the first second and
/// on.
constexpr double kLinesPerSecond = 200.0;
constexpr std::size_t kLongestText = 10000;

hardware::DriveKinds pointers_to(const std::vector<std::unique_ptr<TappedKind>>& kinds) {
  hardware::DriveKinds pointers;
  for (const auto& kind : kinds) pointers.push_back(kind.get());
  return pointers;
}

void require_numbers(const std::string& joint, std::initializer_list<double> values) {
  const bool all =
      std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  require(all, joint + ": what is published is not all numbers");
}

}  // namespace

FuzzedDriver::FuzzedDriver(const std::string& configuration)
    : ledger_(simulation::read_arm(configuration)), limits_(ledger_) {
  for (const hardware::DriveKind* kind : hardware::drive_kinds())
    kinds_.push_back(std::make_unique<TappedKind>(*kind, buses_));
  driver_ = std::make_unique<hardware::MotionHardware>(
      hardware::parse_configuration(YAML::Load(configuration), simulation::robot_description(), {},
                                    pointers_to(kinds_)),
      now_);
  driver_->snapshot(snapshot_);
}

void FuzzedDriver::hold_limits() {
  driver_->set_sample_observer([this](std::size_t joint, const hardware::DemandSample& sample) {
    limits_.sample({sample.time, joint, ledger_.arm().joints[joint].position(sample.demand)});
  });
}

std::vector<double> FuzzedDriver::positions() const {
  std::vector<double> positions;
  for (std::size_t i = 0; i < ledger_.arm().joints.size(); ++i)
    positions.push_back(driver_->emulated_position(i).value_or(0.0));
  return positions;
}

void FuzzedDriver::run(double seconds) {
  const HostTime end = now_ + host_duration(seconds);
  while (now_ < end) {
    now_ = std::min(end, now_ + kLook);
    driver_->update(now_);
    look();
  }
}

void FuzzedDriver::bring_up() {
  const HostTime end = now_ + host_duration(kBringUp);
  const auto is_over = [this] {
    return now_ > HostTime{} && snapshot_.state != motion::GroupState::Starting &&
           snapshot_.state != motion::GroupState::Enabling;
  };
  while (!is_over() && now_ < end) run(0.01);
}

std::optional<Refusal> FuzzedDriver::submit(const trajectory::Goal& goal) {
  const auto answer = driver_->submit(goal, now_);
  if (answer) {
    require(std::isfinite(answer.value().duration.count()), "a goal of no finite duration is accepted");
    require(goals_.insert(answer.value().id).second, "two goals have one id");
    return std::nullopt;
  }
  require(!answer.error().text.empty(), "a goal is refused without a reason");
  return answer.error();
}

std::optional<Refusal> FuzzedDriver::setpoint(const motion::Setpoint& setpoint) {
  return note(driver_->setpoint(setpoint, now_));
}

std::optional<Refusal> FuzzedDriver::write() {
  return note(driver_->write(now_, std::chrono::milliseconds(1)));
}

std::optional<Refusal> FuzzedDriver::note(std::optional<Refusal> refusal) {
  require(!refusal || !refusal->text.empty(), "a setpoint is refused without a reason");
  ledger_.add_setpoint(now_, !refusal);
  return refusal;
}

void FuzzedDriver::move(double distance, double seconds) {
  trajectory::Goal goal;
  trajectory::Waypoint end;
  end.time = GoalTime{seconds};
  for (const auto& joint : snapshot_.joints) {
    goal.joint_names.push_back(joint.joint);
    end.positions.push_back(joint.actual.position + distance);
  }
  goal.points.push_back(end);
  submit(goal);
}

void FuzzedDriver::cancel() {
  for (const motion::GoalId goal : goals_) driver_->cancel(goal, now_);
}

void FuzzedDriver::order(Order order) {
  const auto make = [this, order] {
    switch (order) {
      case Order::Enable:
        return driver_->enable(true, now_);
      case Order::Disable:
        return driver_->enable(false, now_);
      case Order::Reset:
        return driver_->reset_faults(now_);
      case Order::Halt:
        return driver_->halt(now_);
      case Order::Clear:
        break;
    }
    return driver_->clear_buffers(now_);
  };
  require(requests_.insert(make()).second, "two requests have one id");
}

void FuzzedDriver::finish() {
  const HostTime end = now_ + host_duration(kPatience);
  order(Order::Halt);
  requests_.insert(driver_->shut_down(now_));
  while (!is_answered() && now_ < end) run(0.05);
  require(is_answered(), fmt::format("{} goals and {} requests are not answered within {} s", goals_.size(),
                                     requests_.size(), kPatience));
}

void FuzzedDriver::look() {
  driver_->snapshot(snapshot_);
  if (snapshot_.state != ledger_.state()) ledger_.enter(snapshot_.state, now_);
  take_answers();
  take_log();
  check_snapshot();
  check_limits();
}

void FuzzedDriver::check_limits() {
  if (!limits_.violation()) return;
  const simulation::Violation violation{limits_.name(), seconds(now_ - HostTime{}), *limits_.violation()};
  require(simulation::find_known(violation) != nullptr, violation.sentence);
  limits_.forget();
}

void FuzzedDriver::take_answers() {
  while (const auto result = driver_->take_goal_result()) {
    require(goals_.erase(result->id) == 1, "a goal ends that was not accepted, or has ended before");
    const bool told = result->outcome == motion::GoalOutcome::Succeeded || !result->text.empty();
    require(told, "a goal fails without a reason");
  }
  while (const auto result = driver_->take_request_result()) {
    require(requests_.erase(result->id) == 1, "a request is answered that was not made, or twice");
    require(result->success || !result->message.empty(), "a request fails without a reason");
  }
}

void FuzzedDriver::take_log() {
  while (const auto entry = driver_->take_log()) {
    ++log_lines_;
    require(entry->text.size() <= kLongestText, "a line of log is too long: " + entry->text.substr(0, 200));
  }
  const double lines = kLinesPerSecond * (1.0 + seconds(now_ - HostTime{}));
  require(static_cast<double>(log_lines_) <= lines, "too much is logged");
}

void FuzzedDriver::check_snapshot() const {
  require((snapshot_.state == motion::GroupState::Fault) == !snapshot_.fault.empty(),
          "the text of the fault does not fit the state: " + snapshot_.fault);
  require(snapshot_.fault.size() <= kLongestText, "the text of the fault is too long");
  const bool known = snapshot_.active_goal == 0 || goals_.count(snapshot_.active_goal) == 1;
  require(known, "the active goal has ended");
  for (const auto& joint : snapshot_.joints) {
    require_numbers(joint.joint, {joint.desired.position, joint.desired.velocity, joint.desired.acceleration,
                                  joint.actual.position, joint.actual.velocity, joint.demand_position,
                                  joint.following_error, joint.fill_time});
    require(std::isfinite(joint.clock_error_ppm) || std::isnan(joint.clock_error_ppm),
            joint.joint + ": the error of its clock is neither a number nor unknown");
    require(joint.fill <= joint.capacity || joint.capacity == 0,
            joint.joint + ": more records than it can hold");
  }
}

}  // namespace interpolated_motion::fuzz
