#include "interpolated_motion_driver/axis/silverlode/power_stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
using silverlode::Outcome;

namespace {

/// How often the drive is asked at rest.
constexpr HostDuration kRestPeriod = 100ms;
/// How often a drive in fault is asked that does not answer: each time takes the line from the others.
constexpr HostDuration kSilentPeriod = 1s;
/// Periods at rest after which a question no longer waits for an idle line.
constexpr int kOverdue = 4;
/// Looks at a drive that is to come to rest where STP may have been lost or not obeyed: then it is sent
/// again.
constexpr int kLooksAtFault = 50;

/// Requests of a bring-up that two drives have answered; a single one may be noise.
constexpr std::uint64_t kManySecondReplies = 3;

void require_finite(const SilverlodeAxisParameters& parameters, double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw std::invalid_argument(fmt::format(
      "drives/{}/limits/{} is {}: a SilverLode drive needs a finite limit above 0, since its stops are made "
      "with it. Set it in the URDF or in the configuration.",
      parameters.joint, name, value));
}

}  // namespace

SilverlodePowerStage::SilverlodePowerStage(SilverlodeAxisParameters parameters, silverlode::LineMaster& line,
                                           silverlode::DeviceLink& device)
    : AxisBase({parameters.joint, parameters.bring_up_timeout}),
      parameters_(std::move(parameters)),
      line_(line),
      device_(device),
      pace_(parameters_, facts_, line),
      sequence_(device),
      status_(device, parameters_.transmission, parameters_.target_in_motion),
      commands_(parameters_, device, sequence_, status_) {
  require_finite(parameters_, parameters_.limits.max_velocity, "max_velocity");
  require_finite(parameters_, parameters_.limits.max_acceleration, "max_acceleration");
}

void SilverlodePowerStage::attach(SegmentPlayer& player) {
  AxisBase::attach(player);
  player_ = &player;
}

std::string SilverlodePowerStage::description() const {
  return fmt::format("{}: SilverLode drive, revision {}, {}", who(), facts_.revision, player_->queue_text());
}

// Polling.

void SilverlodePowerStage::poll(HostTime now) {
  AxisBase::poll(now);
  look_at_drive(now);
}

/// Gives every outcome to whom it belongs.
void SilverlodePowerStage::listen(HostTime now) {
  while (const auto outcome = device_.take_outcome()) {
    if (player_->take(*outcome, now) || sequence_.take(*outcome, now)) continue;
    status_.take(*outcome);
  }
}

void SilverlodePowerStage::go_on(HostDuration away, HostTime now) {
  sequence_.excuse(away);
  sequence_.poll(now);
}

void SilverlodePowerStage::poll_stage(HostTime now) {
  switch (stage()) {
    case Stage::Configuring:
      return poll_configuring(now);
    case Stage::Disabling:
      if (sequence_done(now)) enter(Stage::Disabled, now);
      return;
    case Stage::Disabled:
      return watch_rest(now);
    case Stage::Enabling:
      if (sequence_done(now)) enter(Stage::Enabled, now);
      return;
    default:
      return;
  }
}

// What waits for the line is served when the line becomes free, which is an event of its own.
HostTime SilverlodePowerStage::next_deadline() const {
  const HostTime work = AxisBase::next_deadline();
  // Places of the queue become free without a word of the drive.
  if (player_->interpolates()) return std::min(work, time().polled() + kPollInterval);
  if (stage() == Stage::Offline || work != kNever) return work;
  return std::max(status_.asked_at() + look_period(), time().polled() + kPollInterval);
}

bool SilverlodePowerStage::sequence_done(HostTime now) {
  if (sequence_.state() == CommandSequence::State::Failed) fail(sequence_.failure(), now);
  return sequence_.state() == CommandSequence::State::Done;
}

void SilverlodePowerStage::drop_work() {
  device_.drop_requests();
  sequence_.cancel();
  heard_stop_ = false;
}

// Bring-up and driver.

void SilverlodePowerStage::forget_drive() {
  device_.drop_requests();
  status_.forget();
}

/// A drive whose replies are late would answer each question but the first with the reply to the one before:
/// so each is asked alone, and its reply is waited for.
void SilverlodePowerStage::probe(HostTime now) {
  silverlode::Request request = silverlode::pol_request(device_.address());
  request.patient = true;
  request.repeatable = false;
  sequence_.start({{request, {}}}, now);
}

std::optional<bool> SilverlodePowerStage::probe_answer() const {
  if (sequence_.running()) return std::nullopt;
  return sequence_.state() == CommandSequence::State::Done;
}

std::string SilverlodePowerStage::no_answer_text() const {
  return fmt::format(
      " ({}). Check its power, the cable, the address (`address` in the configuration; 16 when it leaves the "
      "factory) and the rate (`baud`)",
      sequence_.failure());
}

void SilverlodePowerStage::configure(HostTime now) {
  second_replies_ = device_.statistics().second_replies;
  sequence_.start(commands_.bring_up(player_->queue_steps(), facts_), now);
}

// What was garbled or lost is tried again: nothing moves, and noise may be over soon.
void SilverlodePowerStage::poll_configuring(HostTime now) {
  if (!facts_.found_fault.empty() && !sequence_.running()) {
    notes().add({true, fmt::format("{}: found with a fault, which is cleared now: the drive reports: {}.",
                                   who(), std::exchange(facts_.found_fault, {}))},
                now);
  }
  if (sequence_.unheard() && !time().expired(now, parameters_.bring_up_timeout)) return configure(now);
  if (!sequence_done(now)) return;
  const std::uint64_t second = device_.statistics().second_replies - second_replies_;
  if (second < kManySecondReplies) return enter(Stage::Disabled, now);
  fail(
      fmt::format("{} requests were answered twice: two drives share address {}. Give each an address of its "
                  "own",
                  second, device_.address()),
      now);
}

void SilverlodePowerStage::enable(HostTime now) {
  if (stage() != Stage::Disabled) return;
  enter(Stage::Enabling, now);
  sequence_.start(commands_.enable(), now);
}

void SilverlodePowerStage::disable(HostTime now) {
  if (state() != AxisState::Ready) return AxisBase::disable(now);
  enter(Stage::Disabling, now);
  sequence_.start(commands_.disable(), now);
}

std::optional<bool> SilverlodePowerStage::switch_off(HostTime now) {
  if (sequence_.state() == CommandSequence::State::Idle) sequence_.start(commands_.disable(), now);
  if (sequence_.running()) return std::nullopt;
  return sequence_.state() == CommandSequence::State::Done;
}

// Whatever has happened to it, the drive is set up anew: it may have lost its settings with its power.
void SilverlodePowerStage::reset_fault(HostTime now) {
  if (stage() == Stage::Fault || stage() == Stage::Offline || stage() == Stage::SwitchingOff) bring_up(now);
}

// Watching.

/// Asks the drive for its status when the line has nothing better to do, and after a while even if it has.
void SilverlodePowerStage::look_at_drive(HostTime now) {
  if (stage() == Stage::Offline || stage() == Stage::Probing || stage() == Stage::Configuring) return;
  if (status_.asking()) return;
  const HostDuration waited = now - status_.asked_at();
  const HostDuration period = look_period();
  if (waited < period) return;
  const bool in_motion = line_.bulk_waits() || player_->interpolates();
  const HostDuration overdue = in_motion ? pace_.overdue() : kOverdue * period;
  if (!line_.idle() && waited < overdue) return;
  status_.ask(player_->interpolates(), facts_.multi_register, now);
}

HostDuration SilverlodePowerStage::look_period() const {
  if (player_->interpolates()) return pace_.period();
  const bool in_fault =
      stage() == Stage::Fault || stage() == Stage::FaultStopping || stage() == Stage::SwitchingOff;
  return in_fault && !status_.silence.empty() ? kSilentPeriod : kRestPeriod;
}

void SilverlodePowerStage::watch_rest(HostTime now) {
  if (!status_.silence.empty()) {
    return go_offline(fmt::format("the drive does not answer any more ({}): it is off, disconnected or stuck",
                                  std::exchange(status_.silence, {})),
                      now);
  }
  if (status_.underrun_deceleration && *status_.underrun_deceleration != commands_.underrun_deceleration()) {
    status_.underrun_deceleration.reset();
    return go_offline(
        "the drive has restarted: register 19 is not as it was set, and its position may be lost too", now);
  }
  if (status_.polling.fault()) return fail("the drive reports: " + status_.polling.text(), now);
}

// A fault in motion.

void SilverlodePowerStage::press_stop(HostTime now) {
  if (sequence_.running()) return;
  const auto heard = [this](const Outcome& outcome) -> std::optional<std::string> {
    heard_stop_ = outcome.accepted() || outcome.kind == silverlode::OutcomeKind::Refused;
    return heard_stop_ ? std::nullopt : std::optional<std::string>(device_.text(outcome));
  };
  sequence_.start({commands_.stop(heard), commands_.await_rest(kLooksAtFault), commands_.read_faults(),
                   commands_.read_position()},
                  now);
}

std::string SilverlodePowerStage::cause_text() const {
  return status_.polling.fault() ? " It reports: " + status_.polling.text() + "." : std::string();
}

std::string SilverlodePowerStage::unseen_text() const {
  return sequence_.running() ? "it does not answer" : sequence_.failure();
}

// Results.

void SilverlodePowerStage::drive_status(AxisStatus& out) const {
  const bool faulted = status_.polling.fault();
  out.online = is_online();
  out.state = state_text();
  out.statusword = status_.polling.raw;
  out.mode = 0;
  out.error_code = faulted ? status_.polling.raw : std::uint16_t{0};
  out.error_text = faulted ? status_.polling.text() : std::string();
}

std::string SilverlodePowerStage::state_text() const {
  if (stage() == Stage::FaultStopping) return "Stopping with a fault";
  if (!is_online()) return "Offline";
  if (stage() == Stage::Fault || stage() == Stage::SwitchingOff || status_.polling.fault()) return "Fault";
  if (player_->interpolates()) return "Interpolated motion";
  return enabled() ? "Driver enabled" : "Driver disabled";
}

}  // namespace interpolated_motion::axis
