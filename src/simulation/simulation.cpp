#include "simulation/simulation.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "simulation/known_faults.h"

namespace interpolated_motion::simulation {

using motion::GroupState;

namespace {

constexpr HostDuration kLook = std::chrono::milliseconds(5);
/// While goals are planned: nothing moves for a goal whose acceptance is not known yet.
constexpr HostDuration kAnswerLook = std::chrono::milliseconds(1);
/// s: a drive boots within a second, and is asked anew until then.
constexpr double kBootTime = 2.0;
constexpr double kRestAtTheEnd = 2.0;  // s
constexpr double kLongest = 300.0;     // s of virtual time

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

Outcome thrown(const std::exception& error) {
  Outcome outcome;
  outcome.violation = {"no exception", 0.0, error.what()};
  return outcome;
}

hardware::Configuration parse(const std::string& text) {
  return hardware::parse_configuration(YAML::Load(text), robot_description());
}

}  // namespace

Simulation::Simulation(const Script& script, Trace::Listener listener)
    : script_(script),
      ledger_(read_arm(script.configuration)),
      invariants_(all_invariants(ledger_)),
      trace_(std::move(listener)),
      driver_(std::make_unique<hardware::MotionHardware>(parse(script.configuration), now_)),
      positions_(ledger_.arm().joints.size()),
      powers_(ledger_.arm().joints.size()) {
  driver_->set_motion_observer([this](std::size_t joint, const hardware::DemandSample& sample) {
    if (sample.interpolating) take_sample(joint, sample);
  });
}

Outcome Simulation::run() {
  try {
    run_script();
  } catch (const std::bad_alloc&) {
    end_for_want_of_memory();
  } catch (const std::exception& error) {
    judge({"no exception", script_time(), error.what()});
  }
  for (const motion::BusSnapshot& bus : snapshot_.buses) {
    outcome_.sent[bus.name] = bus.frames_sent;
    outcome_.received[bus.name] = bus.frames_received;
  }
  outcome_.trace = trace_.hash();
  outcome_.seconds = seconds(now_ - HostTime{});
  return outcome_;
}

/// The node's thread of the buses ends, and the process with it: nobody polls the driver any more, and its
/// drives notice that.
void Simulation::end_for_want_of_memory() {
  say("out of memory: the host ends");
  outcome_.out_of_memory = true;
  ledger_.die(now_);
  host_is_there_ = false;
  wait_for_the_end();
}

std::string Simulation::recording(const std::string& cause) const {
  return recording::to_text(driver_->recording(), cause);
}

void Simulation::run_script() {
  if (!script_.at_once) wait_until_ready();
  origin_ = now_;
  for (const Event& event : script_.events) {
    advance_to(origin_ + host_duration(event.time));
    if (is_over()) return;
    look();
    if (ledger_.is_dead()) break;
    carry_out(event);
  }
  wait_for_the_end();
}

void Simulation::wait_until_ready() {
  const auto is_ready = [this] {
    const GroupState state = ledger_.state();
    return now_ > HostTime{} && state != GroupState::Starting && state != GroupState::Enabling;
  };
  const HostTime end = now_ + host_duration(ledger_.arm().bring_up_timeout + kBootTime);
  while (!is_ready() && now_ < end && !is_over()) run_for(0.01);
}

void Simulation::wait_for_the_end() {
  if (ledger_.is_dead()) return run_for(kRestAtTheEnd + ledger_.arm().commit_horizon + kRestAtTheEnd);
  const HostTime end = now_ + host_duration(kLongest);
  const auto is_open = [this] {
    return !handed_in_.empty() || ledger_.has_open_goal() || ledger_.has_open_request(now_) ||
           !setpoints_.empty() || ledger_.state() == GroupState::Streaming;
  };
  while (is_open() && now_ < end && !is_over()) run_for(0.05);
  if (is_open() && !is_over())
    judge({"orders end once", script_time(), fmt::format("the script is not over after {} s", kLongest)});
  if (!is_over()) run_for(kRestAtTheEnd);
}

void Simulation::run_for(double duration) { advance_to(now_ + host_duration(duration)); }

void Simulation::advance_to(HostTime time) {
  while (now_ < time && !is_over()) {
    HostTime next = std::min(time, next_look_);
    if (!setpoints_.empty() && host_is_there_)
      next = std::min(next, std::max(now_, setpoints_.front().arrives));
    if (!handed_in_.empty()) next = std::min(next, now_ + kAnswerLook);
    step(next);
    if (now_ < next_look_) continue;
    next_look_ = now_ + kLook;
    look();
  }
}

void Simulation::step(HostTime time) {
  if (time > now_) {
    now_ = time;
    if (host_is_there_) {
      driver_->update(now_);
      take_answers();
    } else {
      driver_->stall(now_);
    }
  }
  if (host_is_there_) deliver_setpoints();
}

void Simulation::deliver_setpoints() {
  while (!setpoints_.empty() && setpoints_.front().arrives <= now_) {
    const auto refusal = driver_->setpoint(setpoints_.front().setpoint, now_);
    setpoints_.pop_front();
    ledger_.add_setpoint(now_, !refusal);
    if (refusal) say("setpoint refused: " + refusal->text);
  }
}

void Simulation::carry_out(const Event& event) {
  say("> " + to_text(event));
  if (event.verb == "goal") return submit(event);
  if (event.verb == "stop") return submit_stop();
  if (event.verb == "late") return be_late(event.number("for"));
  if (event.verb == "inject") return inject(event);
  if (event.verb == "stream") {
    setpoints_ = make_stream(event, ledger_.arm(), positions_, now_);
  } else if (event.verb == "cancel") {
    if (ledger_.goals().empty()) return;
    const motion::GoalId newest = ledger_.goals().rbegin()->first;
    ledger_.interrupt(newest, event.verb, now_);
    driver_->cancel(newest, now_);
  } else if (event.verb == "speed") {
    ledger_.slow_down();
    if (const auto refused =
            driver_->order_speed({event.number("override"), event.number("paused") != 0.0}, now_))
      say("speed refused: " + refused->text);
  } else if (event.verb == "die") {
    ledger_.die(now_);
    host_is_there_ = false;
  } else {
    carry_out_request(event.verb);
  }
}

void Simulation::carry_out_request(const std::string& verb) {
  if (verb == "enable") return ledger_.request(driver_->enable(true, now_), verb, now_);
  if (verb == "reset") return ledger_.request(driver_->reset_faults(now_), verb, now_);
  ledger_.interrupt(verb, now_);
  if (verb == "disable") return ledger_.request(driver_->enable(false, now_), verb, now_);
  if (verb == "halt") return ledger_.request(driver_->halt(now_), verb, now_);
  if (verb == "clear") return ledger_.request(driver_->clear_buffers(now_), verb, now_);
  throw std::invalid_argument(fmt::format("\"{}\" is no verb", verb));
}

void Simulation::be_late(double duration) {
  const HostTime end = now_ + host_duration(duration);
  ledger_.add_absence(now_, end);
  host_is_there_ = false;
  advance_to(end);
  host_is_there_ = true;
}

void Simulation::inject(const Event& event) {
  std::string reason;
  if (!driver_->inject(event.target, event.command, &reason, now_)) return say("not injected: " + reason);
  ledger_.add_fault(now_, event.target, event.command);
}

void Simulation::look() {
  if (host_is_there_) driver_->snapshot(snapshot_);
  take_positions();
  take_log();
  take_results();
  take_request_results();
  follow_state();
  Look seen;
  seen.now = now_;
  seen.snapshot = &snapshot_;
  seen.positions = &positions_;
  seen.powers = &powers_;
  seen.is_host_there = host_is_there_;
  seen.log_lines = std::exchange(log_lines_, 0);
  seen.report = report_ ? &*report_ : nullptr;
  for (const auto& invariant : invariants_) invariant->look(seen);
  report_.reset();
  find_violation();
}

void Simulation::follow_state() {
  if (snapshot_.state == ledger_.state()) return;
  say(fmt::format("group: {} -> {}{}{}", motion::to_string(ledger_.state()),
                  motion::to_string(snapshot_.state), snapshot_.fault.empty() ? "" : ": ", snapshot_.fault));
  ledger_.enter(snapshot_.state, now_);
  for (const auto& invariant : invariants_) invariant->state_change(now_);
}

void Simulation::take_results() {
  while (const auto result = driver_->take_goal_result()) {
    say(fmt::format("goal {} {}: {}", result->id, name_of(result->outcome), result->text));
    if (result->outcome == motion::GoalOutcome::Succeeded) ++outcome_.goals_succeeded;
    const auto wrong = ledger_.take(*result);
    for (const auto& invariant : invariants_) {
      if (wrong) {
        invariant->wrong_answer(*wrong);
      } else {
        invariant->goal_ended(ledger_.goals().at(result->id));
      }
    }
    report_ = driver_->report();
  }
}

void Simulation::take_request_results() {
  while (const auto result = driver_->take_request_result()) {
    say(fmt::format("request {} {}: {}", result->id, result->success ? "done" : "failed", result->message));
    const auto wrong = ledger_.take(*result);
    for (const auto& invariant : invariants_) {
      if (wrong) {
        invariant->wrong_answer(*wrong);
      } else {
        invariant->request_ended(ledger_.requests().at(result->id));
      }
    }
  }
}

void Simulation::take_log() {
  while (const auto entry = driver_->take_log()) {
    ++log_lines_;
    say("log: " + entry->text);
  }
}

void Simulation::take_sample(std::size_t joint, const hardware::DemandSample& sample) {
  trace_.add(static_cast<std::uint64_t>(sample.time.time_since_epoch().count()));
  trace_.add(sample.demand);
  const Sample seen{sample.time, joint, ledger_.arm().joints[joint].position(sample.demand)};
  for (const auto& invariant : invariants_) invariant->sample(seen);
}

void Simulation::take_positions() {
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    positions_[i] = driver_->emulated_position(i).value_or(0.0);
    powers_[i] = driver_->emulated_power(i).value_or(false);
    trace_.add(positions_[i]);
  }
}

void Simulation::find_violation() {
  for (const auto& invariant : invariants_) {
    if (is_over() || !invariant->violation()) continue;
    judge({invariant->name(), script_time(), *invariant->violation()});
    if (!is_over()) invariant->forget();
  }
}

/// A known fault is noted, and the simulation goes on: what else goes wrong is to be seen.
void Simulation::judge(const Violation& violation) {
  const KnownFault* known = find_known(violation);
  if (known == nullptr) {
    outcome_.violation = violation;
    return say("VIOLATED: " + violation.invariant + ": " + violation.sentence);
  }
  if (outcome_.known.emplace(known->name, violation).second)
    say("known: " + known->name + ": " + violation.sentence);
}

void Simulation::say(const std::string& line) { trace_.say(script_time(), line); }

double Simulation::script_time() const { return seconds(now_ - origin_); }

Outcome simulate(const Script& script, Trace::Listener listener) {
  try {
    return Simulation(script, std::move(listener)).run();
  } catch (const std::exception& error) {
    return thrown(error);
  }
}

Outcome simulate_recorded(const Script& script, std::string& recording) {
  try {
    Simulation simulation(script);
    Outcome outcome = simulation.run();
    recording = simulation.recording(outcome.violation ? outcome.violation->sentence : "no violation");
    return outcome;
  } catch (const std::exception& error) {
    return thrown(error);
  }
}

}  // namespace interpolated_motion::simulation
