#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/queue_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/register_delivery.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace registers = silverlode::registers;

namespace {

/// How often the drive is asked at rest.
constexpr HostDuration kRestPeriod = 100ms;
/// How often a drive in fault is asked that does not answer: each time takes the line from the others.
constexpr HostDuration kSilentPeriod = 1s;
/// Periods after which a question no longer waits for an idle line.
constexpr int kOverdue = 4;
/// The part of `feedback_timeout` after which it no longer waits for segments: a line that is slower than
/// planned has always one waiting. Every other question is for the position, and an answer takes its time.
constexpr int kPartOfTimeout = 3;

void require_finite(const SilverlodeAxisParameters& parameters, double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw std::invalid_argument(fmt::format(
      "drives/{}/limits/{} is {}: a SilverLode drive needs a finite limit above 0, since its stops are made "
      "with it. Set it in the URDF or in the configuration.",
      parameters.joint, name, value));
}

std::unique_ptr<SegmentDelivery> make_delivery(const SilverlodeAxisParameters& parameters,
                                               const DeliveryContext& context) {
  if (parameters.queue == SegmentQueue::Registers)
    return std::make_unique<RegisterDelivery>(context, parameters.segment_registers);
  return std::make_unique<QueueDelivery>(context, static_cast<std::size_t>(parameters.queue_depth));
}

}  // namespace

SilverlodeAxis::SilverlodeAxis(SilverlodeAxisParameters parameters, silverlode::LineMaster& line,
                               silverlode::DeviceLink& device, LineStart* common_start)
    : AxisBase({parameters.joint, parameters.bring_up_timeout}),
      parameters_(std::move(parameters)),
      line_(line),
      device_(device),
      common_start_(common_start),
      sequence_(device),
      status_(device, parameters_.transmission),
      clock_(parameters_.max_clock_error, 0.5 * seconds(parameters_.execution_time),
             PlaybackClock::Estimate::Middle),
      delivery_(
          make_delivery(parameters_, {line_, device_, sequence_, feed_, clock_, parameters_.line_share})) {
  require_finite(parameters_, parameters_.limits.max_velocity, "max_velocity");
  require_finite(parameters_, parameters_.limits.max_acceleration, "max_acceleration");
  encoding().validate();
  if (common_start_ != nullptr) start_member_ = common_start_->join();
}

AxisState SilverlodeAxis::enabled_state() const {
  switch (phase_) {
    case Phase::Clearing:
    case Phase::Filling:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Starting:
    case Phase::Verifying:
    case Phase::Moving:
    case Phase::Ending:
      return AxisState::Moving;
    case Phase::Braking:
    case Phase::Emptying:
      return AxisState::Stopping;
    case Phase::Off:
    case Phase::Ready:
      break;
  }
  return AxisState::Ready;
}

void SilverlodeAxis::poll(HostTime now) {
  AxisBase::poll(now);
  look_at_drive(now);
}

void SilverlodeAxis::go_on(HostDuration away, HostTime now) {
  sequence_.excuse(away);
  sequence_.poll(now);
}

void SilverlodeAxis::poll_stage(HostTime now) {
  switch (stage()) {
    case Stage::Configuring:
    case Stage::Disabling:
      return advance_when_done(Stage::Disabled, now);
    case Stage::Disabled:
      return watch_rest(now);
    case Stage::Enabling:
      phase_ = Phase::Ready;
      return advance_when_done(Stage::Enabled, now);
    default:
      return poll_enabled(now);
  }
}

void SilverlodeAxis::poll_enabled(HostTime now) {
  switch (phase_) {
    case Phase::Clearing:
      return poll_clearing(now);
    case Phase::Filling:
      return poll_filling(now);
    case Phase::Starting:
      return poll_starting(now);
    case Phase::Verifying:
      return poll_verifying(now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Ending:
      return poll_ending(now);
    case Phase::Braking:
      return poll_braking(now);
    case Phase::Emptying:
      if (sequence_done(now)) enter_phase(Phase::Ready, now);
      return;
    case Phase::Ready:
    case Phase::Loaded:
      return watch_rest(now);
    case Phase::Off:
      return;
  }
}

// What waits for the line is served when the line becomes free, which is an event of its own.
HostTime SilverlodeAxis::next_deadline() const {
  if (stage() == Stage::Offline) return kNever;
  const HostTime work = polled() + (phase() == Phase::Moving ? kMotionPollInterval : kPollInterval);
  const bool rests = AxisBase::next_deadline() == kNever;
  return rests ? std::max(status_.asked_at() + look_period(), work) : work;
}

/// Gives every outcome to whom it belongs.
void SilverlodeAxis::listen(HostTime now) {
  const HostTime known = feedback().time;
  while (const auto outcome = device_.take_outcome()) {
    if (delivery_->owns(*outcome)) {
      if (const auto failure = delivery_->take(*outcome, now)) fail(*failure, now);
    } else if (outcome->id == start_id_) {
      start_id_ = silverlode::kNoRequest;
      take_start(*outcome, now);
    } else if (!sequence_.take(*outcome, now)) {
      status_.take(*outcome);
    }
  }
  if (feedback().time != known) note_report();
}

// ---- bring-up and power stage: what the commands do is in bring_up.cpp
// ---------------------------------------

void SilverlodeAxis::forget_drive() {
  device_.drop_requests();
  status_.forget();
}

void SilverlodeAxis::probe(HostTime now) {
  sequence_.start({{silverlode::pol_request(device_.address()), {}}}, now);
}

std::optional<bool> SilverlodeAxis::probe_answer() const {
  if (sequence_.running()) return std::nullopt;
  return sequence_.state() == CommandSequence::State::Done;
}

std::string SilverlodeAxis::no_answer_text() const {
  return fmt::format(
      " ({}). Check its power, the cable, the address (`address` in the configuration; 16 when it leaves the "
      "factory) and the rate (`baud`)",
      sequence_.failure());
}

void SilverlodeAxis::configure(HostTime now) { sequence_.start(bring_up_steps(), now); }

void SilverlodeAxis::advance_when_done(Stage next, HostTime now) {
  if (sequence_done(now)) enter(next, now);
}

void SilverlodeAxis::enable(HostTime now) {
  if (stage() != Stage::Disabled) return;
  enter(Stage::Enabling, now);
  sequence_.start(enable_steps(), now);
}

void SilverlodeAxis::disable(HostTime now) {
  if (phase() != Phase::Ready) return;
  enter(Stage::Disabling, now);
  sequence_.start({{silverlode::dmd_request(device_.address()), {}}}, now);
}

// Whatever has happened to it, the drive is set up anew: it may have lost its settings with its power.
void SilverlodeAxis::reset_fault(HostTime now) {
  if (stage() == Stage::Fault || stage() == Stage::Offline) bring_up(now);
}

// ---- watching
// ------------------------------------------------------------------------------------------------------------------

/// Asks the drive for its status when the line has nothing better to do, and after a while even if it has.
void SilverlodeAxis::look_at_drive(HostTime now) {
  if (stage() == Stage::Offline || stage() == Stage::Probing || stage() == Stage::Configuring) return;
  if (status_.asking()) return;
  const HostDuration waited = now - status_.asked_at();
  const HostDuration period = look_period();
  const HostDuration overdue =
      line_.bulk_waits() ? parameters_.feedback_timeout / kPartOfTimeout : kOverdue * period;
  if (waited < period || (!line_.idle() && waited < overdue)) return;
  status_.ask(is_motion_phase(), multi_register_, now);
}

HostDuration SilverlodeAxis::look_period() const {
  if (is_motion_phase()) return parameters_.status_period;
  const bool in_fault = stage() == Stage::Fault || stage() == Stage::FaultStopping;
  return in_fault && !status_.silence.empty() ? kSilentPeriod : kRestPeriod;
}

void SilverlodeAxis::watch_rest(HostTime now) {
  if (!status_.silence.empty()) {
    return go_offline(fmt::format("the drive does not answer any more ({}): it is off, disconnected or stuck",
                                  std::exchange(status_.silence, {})),
                      now);
  }
  if (status_.underrun_deceleration && *status_.underrun_deceleration != underrun_deceleration()) {
    status_.underrun_deceleration.reset();
    return go_offline(
        "the drive has restarted: register 19 is not as it was set, and its position may be lost too", now);
  }
  if (status_.polling.fault()) return fail("the drive reports: " + status_.polling.text(), now);
}

// ---- results
// -------------------------------------------------------------------------------------------------------------------

void SilverlodeAxis::enter_phase(Phase phase, HostTime now) {
  phase_ = phase;
  begin_phase(now);
}

bool SilverlodeAxis::sequence_done(HostTime now) {
  if (sequence_.state() == CommandSequence::State::Failed) fail(sequence_.failure(), now);
  return sequence_.state() == CommandSequence::State::Done;
}

void SilverlodeAxis::give_up(HostTime) {
  delivery_->give_up();
  device_.drop_requests();
  sequence_.cancel();
  withdraw_start();
  clock_.stop();
  heard_stop_ = false;
}

}  // namespace interpolated_motion::axis
