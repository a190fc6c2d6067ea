#include "simulation/ledger.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

// s. A stop takes a braking of at most max_velocity / max_acceleration (0.7 s), the way of the order to the
// drives, and the look whether they stand.
constexpr double kStopping = 3.0;
constexpr double kRequest = 3.0;
/// What a fault may add: a drive that is away for up to 2 s and has to be configured anew, and repeats on its
/// bus.
constexpr double kDisturbed = 8.0;
/// What a pause or another speed may add.
constexpr double kSlowedDown = 120.0;
/// Until an answer that is overdue has been noticed.
constexpr HostDuration kUntilNoticed = std::chrono::milliseconds(100);

}  // namespace

double Ledger::patience() const { return disturbed_ ? kDisturbed + arm_.commit_horizon : 0.0; }

void Ledger::slow_down() {
  if (std::exchange(slowed_down_, true)) return;
  for (auto& [id, goal] : goals_) {
    if (goal.ended_by.empty()) goal.due += host_duration(kSlowedDown);
  }
}

void Ledger::accept(motion::GoalId id, GoalEntry entry) {
  if (slowed_down_) entry.due += host_duration(kSlowedDown);
  entry.due += host_duration(patience() + (entry.met_motion ? arm_.commit_horizon : 0.0));
  goals_[id] = std::move(entry);
}

void Ledger::interrupt(const std::string& verb, HostTime now) {
  for (auto& [id, goal] : goals_)
    if (!goal.result) interrupt(id, verb, now);
}

void Ledger::interrupt(motion::GoalId id, const std::string& verb, HostTime now) {
  const auto found = goals_.find(id);
  if (found == goals_.end() || found->second.result || !found->second.ended_by.empty()) return;
  found->second.ended_by = verb;
  const double committed =
      verb == "goal" ? arm_.commit_horizon : 0.0;  // it may end there, and not be stopped
  found->second.due = std::min(found->second.due, now + host_duration(committed + kStopping + patience()));
}

void Ledger::request(motion::RequestId id, const std::string& verb, HostTime now) {
  double time = kRequest + patience();
  if (verb == "reset" || state_ == motion::GroupState::Starting) time += arm_.bring_up_timeout;
  requests_[id] = {verb, now, now + host_duration(time), std::nullopt};
}

std::optional<std::string> Ledger::take(const motion::GoalResult& result) {
  const auto found = goals_.find(result.id);
  if (found == goals_.end()) return fmt::format("goal {} has ended, which was never accepted", result.id);
  if (found->second.result) return fmt::format("goal {} has ended twice", result.id);
  found->second.result = result;
  return std::nullopt;
}

std::optional<std::string> Ledger::take(const motion::RequestResult& result) {
  const auto found = requests_.find(result.id);
  if (found == requests_.end()) return fmt::format("request {} is answered, which was never made", result.id);
  if (found->second.result)
    return fmt::format("request {} ({}) is answered twice", result.id, found->second.verb);
  found->second.result = result;
  return std::nullopt;
}

void Ledger::add_setpoint(HostTime now, bool accepted) {
  if (!accepted) return;
  ++setpoints_;
  last_setpoint_ = now;
}

void Ledger::add_fault(HostTime now, std::string target, std::string command) {
  faults_.push_back({now, std::move(target), std::move(command)});
  disturb(now);
}

void Ledger::disturb(HostTime now) {
  disturbed_ = true;
  const HostTime due = now + host_duration(patience());
  for (auto& [id, goal] : goals_) goal.due = std::max(goal.due, due);
  for (auto& [id, request] : requests_) request.due = std::max(request.due, due);
}

void Ledger::add_absence(HostTime from, HostTime until) {
  const bool tolerated = seconds(until - from) <= arm_.tolerated_absence(state_);
  absences_.push_back({from, until, tolerated});
  for (auto& [id, goal] : goals_) goal.due += until - from;
  for (auto& [id, request] : requests_) request.due += until - from;
  if (!tolerated) disturb(until);
}

std::uint32_t Ledger::syncs_in_absences(HostTime since, double period) const {
  std::uint32_t syncs = 0;
  for (const Absence& absence : absences_) {
    if (absence.until < since) continue;
    syncs += 1U + static_cast<std::uint32_t>(seconds(absence.until - absence.from) / period);
  }
  return syncs;
}

// Sent is the target position for the next SYNC, and it is reached a period behind that. The first one after
// an absence comes with the next SYNC again, and until a period behind that the drive goes on as it went.
bool Ledger::are_drives_alone(HostTime when, double period) const {
  return std::any_of(absences_.begin(), absences_.end(), [&](const Absence& absence) {
    const HostTime last = absence.until + host_duration(2.0 * period);
    return !absence.tolerated && when > absence.from + host_duration(period) && when <= last;
  });
}

void Ledger::enter(motion::GroupState state, HostTime now) {
  former_state_ = state_;
  state_ = state;
  state_since_ = now;
}

bool Ledger::has_open_goal() const {
  return std::any_of(goals_.begin(), goals_.end(), [](const auto& goal) { return !goal.second.result; });
}

bool Ledger::has_open_request(HostTime now) const {
  return std::any_of(requests_.begin(), requests_.end(), [now](const auto& request) {
    return !request.second.result && now < request.second.due + kUntilNoticed;
  });
}

bool Ledger::is_touched(std::size_t joint, HostTime now, double within) const {
  const Joint& about = arm_.joints[joint];
  return std::any_of(faults_.begin(), faults_.end(), [&](const FaultEntry& fault) {
    return (fault.target == about.name || fault.target == about.bus) && seconds(now - fault.time) <= within;
  });
}

bool Ledger::has_fault(const std::string& target, HostTime now, double within) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const FaultEntry& fault) {
    return fault.target == target && seconds(now - fault.time) <= within;
  });
}

bool Ledger::has_order_since(HostTime when) const {
  if (last_setpoint_ >= when) return true;
  return std::any_of(goals_.begin(), goals_.end(), [when](const auto& goal) {
    return !goal.second.is_stop && goal.second.accepted >= when;
  });
}

bool Ledger::has_request_since(const std::string& verb, HostTime when) const {
  return std::any_of(requests_.begin(), requests_.end(), [&](const auto& request) {
    return request.second.verb == verb && request.second.made >= when;
  });
}

}  // namespace interpolated_motion::simulation
