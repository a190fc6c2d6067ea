#include "interpolated_motion_driver/axis/epos_axis.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace object = cia402::object;
using canopen::sdo_write;
using canopen::SdoResult;

namespace {

/// Longest a drive may take for one change of state.
constexpr HostDuration kStateTimeout = 2s;
/// How often an axis wants to be polled while it works towards something.
constexpr HostDuration kPollInterval = 5ms;
/// Polls further apart than this mean that the host was away: stopped, or starved by other programs.
constexpr HostDuration kHostStall = 100ms;

void require_finite(const EposAxisParameters& parameters, double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw std::invalid_argument(
      fmt::format("drives/{}/limits/{} is {}: an EPOS drive needs a finite limit above 0, since it checks "
                  "every motion against it. Set "
                  "it in the URDF or in the configuration.",
                  parameters.joint, name, value));
}

}  // namespace

EposAxis::EposAxis(EposAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node)
    : parameters_(std::move(parameters)),
      master_(master),
      node_(node),
      sequence_(node),
      controlword_(master, node, epos_pdo::kControlwordRpdo) {
  require_finite(parameters_, parameters_.limits.max_velocity, "max_velocity");
  require_finite(parameters_, parameters_.limits.max_acceleration, "max_acceleration");
  node_.set_sync_answer(epos_pdo::kMotionTpdo);
  node_.set_sync_answer(epos_pdo::kBufferTpdo);
  node_.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

AxisState EposAxis::state() const {
  switch (phase_) {
    case Phase::Offline:
      return AxisState::Offline;
    case Phase::Probing:
    case Phase::Configuring:
    case Phase::StartingNode:
    case Phase::Resetting:
      return AxisState::Configuring;
    case Phase::Disabled:
      return AxisState::Disabled;
    case Phase::SelectingMode:
    case Phase::Enabling:
    case Phase::ReadingRest:
      return AxisState::Enabling;
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Verifying:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Armed:
    case Phase::Moving:
    case Phase::Ending:
      return AxisState::Moving;
    case Phase::Braking:
    case Phase::Emptying:
    case Phase::Disabling:
      return AxisState::Stopping;
    case Phase::Fault:
      break;
  }
  return AxisState::Fault;
}

// ---- polling
// -------------------------------------------------------------------------------------------------------

void EposAxis::poll(HostTime now) {
  forgive_stall(now);
  collect_emergencies();
  watch_heartbeat(now);
  watch_power_stage(now);
  sequence_.poll(now);
  run_phase(now);
}

/// The time limit of a phase is for the drive: what the host was away for does not count.
void EposAxis::forgive_stall(HostTime now) {
  const HostDuration away = now - polled_;
  if (away > kHostStall && polled_ >= phase_since_) phase_since_ += away;
  polled_ = now;
}

HostTime EposAxis::next_deadline() const {
  switch (phase_) {
    case Phase::Offline:
    case Phase::Disabled:
    case Phase::Ready:
    case Phase::Loaded:
    case Phase::Fault:
      return kNever;
    default:
      return polled_ + kPollInterval;
  }
}

void EposAxis::run_phase(HostTime now) {
  switch (phase_) {
    case Phase::Probing:
      return poll_probing(now);
    case Phase::Configuring:
      return poll_configuring(now);
    case Phase::StartingNode:
      return poll_starting_node(now);
    case Phase::SelectingMode:
      return poll_selecting_mode(now);
    case Phase::Enabling:
      return poll_enabling(now);
    case Phase::ReadingRest:
      return poll_reading_rest(now);
    case Phase::Clearing:
      return poll_clearing(now);
    case Phase::Filling:
      return poll_filling(now);
    case Phase::Verifying:
      return poll_verifying(now);
    case Phase::Armed:
      return poll_armed(now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Ending:
      return poll_ending(now);
    case Phase::Braking:
      return poll_braking(now);
    case Phase::Emptying:
      return poll_emptying(now);
    case Phase::Disabling:
      return poll_disabling(now);
    case Phase::Resetting:
      return poll_resetting(now);
    case Phase::Offline:
    case Phase::Disabled:
    case Phase::Ready:
    case Phase::Loaded:
    case Phase::Fault:
      return;
  }
}

// ---- bring-up
// ------------------------------------------------------------------------------------------------------

void EposAxis::bring_up(HostTime now) {
  configured_ = false;
  early_release_.reset();
  fault_text_.clear();
  bring_up_since_ = now;
  enter(Phase::Probing, now);
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

// A drive that is still booting does not answer: asked again until the time for bring-up is over.
void EposAxis::poll_probing(HostTime now) {
  if (sequence_.running()) return;
  if (sequence_.state() == SdoSequence::State::Done) {
    facts_ = EposFacts{};
    enter(Phase::Configuring, now);
    return sequence_.start(bring_up_steps(parameters_, node_.id(), sequence_, facts_), now);
  }
  if (now - bring_up_since_ > parameters_.bring_up_timeout) {
    return go_offline(
        fmt::format("no drive answers within {:.1f} s. Check its power, the cable and its termination, the "
                    "node id (node_id in the configuration, switches on the drive) and the bit rate",
                    seconds(parameters_.bring_up_timeout)),
        now);
  }
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

void EposAxis::poll_configuring(HostTime now) {
  if (!sequence_done(now)) return;
  enter(Phase::StartingNode, now);
  node_.send_nmt(canopen::NmtCommand::Start);
}

// The first statusword shows that PDOs flow. A drive may come up enabled or in fault from an earlier life of
// the host.
void EposAxis::poll_starting_node(HostTime now) {
  if (telemetry_.status_time <= phase_since_ || telemetry_.motion_time <= phase_since_) {
    if (expired(now, kStateTimeout)) fail("no PDO arrives from the drive after NMT start", now);
    return;
  }
  configured_ = true;
  if (telemetry_.statusword.state() == cia402::State::Fault) return enter(Phase::Resetting, now);
  enter(Phase::Disabling, now);
}

// ---- power stage
// ---------------------------------------------------------------------------------------------------

void EposAxis::enable(HostTime now) {
  if (phase_ != Phase::Disabled) return;
  enter(Phase::SelectingMode, now);
  const auto mode = static_cast<std::int8_t>(cia402::Mode::InterpolatedPosition);
  sequence_.start({SdoSequence::write(sdo_write<std::int8_t>(object::kModeOfOperation, mode)), read_mode()},
                  now);
}

SdoSequence::Step EposAxis::read_mode() {
  return SdoSequence::read(object::kModeDisplay, [this](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    telemetry_.mode = r.as_i8();
    return std::nullopt;
  });
}

// Selecting the mode empties the FIFO, so nothing may be loaded before the drive shows it.
void EposAxis::poll_selecting_mode(HostTime now) {
  if (!sequence_done(now)) return;
  if (telemetry_.mode == static_cast<std::int8_t>(cia402::Mode::InterpolatedPosition)) {
    enter(Phase::Enabling, now);
  } else if (expired(now, kStateTimeout)) {
    fail(fmt::format("mode 7 was selected but the drive shows mode {} (0x6061)", telemetry_.mode), now);
  } else {
    sequence_.start({read_mode()}, now);
  }
}

void EposAxis::poll_enabling(HostTime now) {
  if (walk_to(cia402::State::OperationEnabled, now)) read_rest({}, Phase::ReadingRest, now);
}

void EposAxis::poll_reading_rest(HostTime now) {
  if (sequence_done(now)) enter(Phase::Ready, now);
}

void EposAxis::disable(HostTime now) {
  if (phase_ == Phase::Ready) enter(Phase::Disabling, now);
}

void EposAxis::poll_disabling(HostTime now) {
  if (walk_to(cia402::State::SwitchOnDisabled, now)) enter(Phase::Disabled, now);
}

void EposAxis::reset_fault(HostTime now) {
  if (phase_ != Phase::Fault && phase_ != Phase::Offline) return;
  fault_text_.clear();
  if (!configured_) return bring_up(now);
  enter(Phase::Resetting, now);
}

void EposAxis::poll_resetting(HostTime now) {
  if (controlword_.reset(telemetry_.statusword.state(), telemetry_.status_time, phase_since_, now)) {
    error_code_ = 0;
    error_text_.clear();
    return enter(Phase::Disabled, now);
  }
  if (expired(now, kStateTimeout)) fail("the fault cannot be reset: " + drive_fault(), now);
}

/// Sends the controlwords that lead to `target`; true once the drive is there.
bool EposAxis::walk_to(cia402::State target, HostTime now) {
  using Progress = ControlwordLink::Progress;
  const Progress progress = controlword_.walk(telemetry_.statusword.state(), target, phase_since_, now);
  if (progress == Progress::Arrived) return true;
  if (progress == Progress::NeedsFaultReset) {
    fail(drive_fault(), now);
  } else if (expired(now, kStateTimeout)) {
    fail(fmt::format("the drive does not get to \"{}\" within {:.0f} s; statusword: {}",
                     cia402::to_text(target), seconds(kStateTimeout), telemetry_.statusword.text()),
         now);
  }
  return false;
}

bool EposAxis::sequence_done(HostTime now) {
  if (sequence_.state() == SdoSequence::State::Failed) fail(sequence_.failure(), now);
  return sequence_.state() == SdoSequence::State::Done;
}

/// Does `before`, then reads where the demand rests, in `phase`.
void EposAxis::read_rest(std::vector<SdoSequence::Step> before, Phase phase, HostTime now) {
  before.push_back(
      SdoSequence::read(object::kPositionDemand, [this](const SdoResult& r) -> std::optional<std::string> {
        if (!r.ok) return r.text();
        rest_counts_ = r.as_i32();
        return std::nullopt;
      }));
  enter(phase, now);
  sequence_.start(std::move(before), now);
}

// ---- what the drive tells
// ------------------------------------------------------------------------------------------

void EposAxis::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  const cia402::BufferStatus before = telemetry_.buffer_status;
  if (!telemetry_.take(number, frame, time, master_.last_sync_time())) return;
  note_buffer_errors(before);
  if (number != epos_pdo::kMotionTpdo) return;
  feedback_.time = telemetry_.motion_time;
  feedback_.position = parameters_.transmission.joint_position(telemetry_.position);
  feedback_.velocity = parameters_.transmission.joint_velocity(counts_per_second(telemetry_.velocity));
}

double EposAxis::counts_per_second(std::int32_t velocity) const {
  return velocity * facts_.velocity_unit_rpm() / 60.0 * parameters_.transmission.counts_per_revolution;
}

void EposAxis::note_buffer_errors(cia402::BufferStatus before) {
  const cia402::BufferStatus& after = telemetry_.buffer_status;
  if (after.underflow_error() && !before.underflow_error()) ++underruns_;
  if (after.overflow_error() && !before.overflow_error()) ++overflows_;
}

void EposAxis::collect_emergencies() {
  while (auto emcy = node_.take_emcy()) {
    if (emcy->code == cia402::emergency_code::kReset) continue;
    error_code_ = emcy->code;
    error_text_ = cia402::emergency_text(*emcy);
  }
}

void EposAxis::watch_heartbeat(HostTime now) {
  while (auto event = node_.heartbeat().take_event()) {
    if (phase_ == Phase::Offline || phase_ == Phase::Probing) continue;
    if (*event == canopen::HeartbeatEvent::Lost) {
      return go_offline(
          fmt::format("no heartbeat from the drive for {:.2f} s: it is off, disconnected or stuck",
                      seconds(parameters_.heartbeat_timeout)),
          now);
    }
    if (*event != canopen::HeartbeatEvent::BootUp) continue;
    if (phase_ == Phase::Configuring) return bring_up(now);
    return go_offline(
        "the drive has restarted (boot-up message): it lost its power or was reset, and with it its FIFO "
        "and settings",
        now);
  }
}

bool EposAxis::must_be_enabled() const {
  switch (phase_) {
    case Phase::ReadingRest:
    case Phase::Ready:
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Verifying:
    case Phase::Loaded:
    case Phase::Armed:
    case Phase::Moving:
    case Phase::Ending:
    case Phase::Braking:
    case Phase::Emptying:
      return true;
    default:
      return false;
  }
}

void EposAxis::watch_power_stage(HostTime now) {
  const cia402::State state = telemetry_.statusword.state();
  const bool faulted = state == cia402::State::Fault || state == cia402::State::FaultReactionActive;
  if (phase_ == Phase::Disabled && faulted) return fail(drive_fault(), now);
  if (!must_be_enabled() || state == cia402::State::OperationEnabled) return;
  fail(faulted ? drive_fault()
               : fmt::format("the drive left operation enabled by itself; statusword: {}",
                             telemetry_.statusword.text()),
       now);
}

std::string EposAxis::drive_fault() const {
  std::string text = fmt::format("the drive is in {}", cia402::to_text(telemetry_.statusword.state()));
  if (!error_text_.empty()) text += ": " + error_text_;
  if (telemetry_.buffer_status.any_error()) text += ", FIFO: " + telemetry_.buffer_status.text();
  return text;
}

// ---- results
// -------------------------------------------------------------------------------------------------------

void EposAxis::enter(Phase phase, HostTime now) {
  phase_ = phase;
  phase_since_ = now;
}

std::string EposAxis::who() const { return fmt::format("Joint {} ({})", parameters_.joint, node_.name()); }

std::string EposAxis::description() const {
  return fmt::format("{}: {}, serial number {}, velocity unit {} rpm, FIFO of {} records, {}", who(),
                     cia402::describe_identity(facts_.identity), facts_.identity.serial,
                     facts_.velocity_unit_rpm(), facts_.capacity, clock_text());
}

std::string EposAxis::clock_text() const {
  if (facts_.takes_time_stamps) return "clock set by the host's (0x1013)";
  if (!parameters_.clock_discipline) return "clock on its own (clock_discipline is false)";
  return "clock on its own, it takes no time stamps: " + facts_.time_stamp_refusal;
}

void EposAxis::fail(const std::string& reason, HostTime now) {
  fault_text_ = fmt::format("{}: {}.", who(), reason);
  node_.clear_records();
  sequence_.cancel();
  enter(Phase::Fault, now);
}

void EposAxis::go_offline(const std::string& reason, HostTime now) {
  fail(reason, now);
  configured_ = false;
  enter(Phase::Offline, now);
}

double EposAxis::rest_position() const {
  const bool known = must_be_enabled();
  return parameters_.transmission.joint_position(known ? rest_counts_ : telemetry_.position);
}

void EposAxis::status(HostTime now, AxisStatus& out) const {
  const auto& transmission = parameters_.transmission;
  const double elapsed = clock_.elapsed(now);
  const bool loading = phase_ == Phase::Filling || phase_ == Phase::Verifying || phase_ == Phase::Loaded;
  out.online = phase_ != Phase::Offline && phase_ != Phase::Probing;
  out.state = std::string(cia402::to_text(telemetry_.statusword.state()));
  out.statusword = telemetry_.statusword.raw;
  out.mode = telemetry_.mode;
  out.demand_position = transmission.joint_position(telemetry_.position_demand);
  out.following_error = telemetry_.following_error / transmission.counts_per_radian();
  out.error_code = error_code_;
  out.error_text = error_text_;
  out.capacity = facts_.capacity;
  out.fill =
      loading || is_motion_phase() ? static_cast<std::uint32_t>(feed_.sent() - feed_.played(elapsed)) : 0;
  out.fill_time = loading || is_motion_phase() ? feed_.time_ahead(elapsed) : 0.0;
  out.underflow_warning = telemetry_.buffer_status.underflow_warning();
  out.overflow_warning = telemetry_.buffer_status.overflow_warning();
  out.velocity_warning = telemetry_.buffer_status.velocity_warning();
  out.acceleration_warning = telemetry_.buffer_status.acceleration_warning();
  out.underruns = underruns_;
  out.overflows = overflows_;
  out.refused_writes = refused_writes_;
  out.records_sent = records_sent_;
  out.clock_error_ppm = clock_.error_ppm();
}

AxisReport EposAxis::report() const {
  return {feed_.sent(), minimum_fill_, underruns_ - underruns_at_load_, refused_writes_ - refused_at_load_};
}

}  // namespace interpolated_motion::axis
