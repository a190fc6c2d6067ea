#include "interpolated_motion_driver/axis/cyclic_axis.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cyclic_bring_up.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/cyclic_objects.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace object = cia402::object;
using canopen::SdoResult;

namespace {

/// Longest a drive may take for one change of state.
constexpr HostDuration kStateTimeout = 2s;
/// How often an axis wants to be polled while it works towards something.
constexpr HostDuration kPollInterval = 5ms;
constexpr auto kMode = static_cast<std::int8_t>(cia402::Mode::CyclicSynchronousPosition);

void require(bool valid, const CyclicAxisParameters& parameters, const char* name, double value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(
      fmt::format("drives/{}/{} is {}, allowed is {}", parameters.joint, name, value, range));
}

CyclicAxisParameters checked(CyclicAxisParameters p) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool whole = p.sync_period % 1ms == 0ns && p.sync_period >= 1ms && p.sync_period <= 20ms;
  require(positive(p.limits.max_velocity), p, "limits/max_velocity", p.limits.max_velocity,
          "a finite number above 0");
  require(positive(p.limits.max_acceleration), p, "limits/max_acceleration", p.limits.max_acceleration,
          "a finite number above 0, since stops are made with it");
  require(whole, p, "sync_period", seconds(p.sync_period), "a whole number of ms, 0.001..0.02 s (0x60C2)");
  require(p.interpolation_order >= 1 && p.interpolation_order <= 3, p, "interpolation_order",
          p.interpolation_order, "1..3");
  require(positive(p.servo_period) && p.servo_period <= seconds(p.sync_period), p, "servo_period",
          p.servo_period, "above 0 to sync_period");
  require(positive(p.velocity_unit), p, "velocity_unit", p.velocity_unit, "a finite number above 0");
  require(positive(p.acceleration_unit), p, "acceleration_unit", p.acceleration_unit,
          "a finite number above 0");
  return p;
}

std::string text_of(const canopen::Emcy& emcy) {
  const bool sync = emcy.code == cia402::emergency_code::kSyncController;
  return fmt::format("EMCY 0x{:04X}{} (error register 0x{:02X}: {})", emcy.code,
                     sync ? " sync controller, target positions have failed to come" : "",
                     emcy.error_register, cia402::error_register_text(emcy.error_register));
}

}  // namespace

CyclicAxis::CyclicAxis(CyclicAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node)
    : parameters_(checked(std::move(parameters))),
      master_(master),
      node_(node),
      sequence_(node),
      controlword_(master, node, cyclic_pdo::kControlwordRpdo),
      setpoints_(parameters_.transmission, parameters_.sync_period, parameters_.interpolation_order) {
  const auto& bus = master_.parameters();
  require(bus.isochronous && bus.sync_period == parameters_.sync_period, parameters_, "sync_period",
          seconds(parameters_.sync_period), "that of an isochronous bus");
  node_.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

AxisState CyclicAxis::state() const {
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
      return AxisState::Enabling;
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Loading:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Moving:
      return AxisState::Moving;
    case Phase::Braking:
    case Phase::Disabling:
      return AxisState::Stopping;
    case Phase::Fault:
      break;
  }
  return AxisState::Fault;
}

// ---- polling

void CyclicAxis::poll(HostTime now) {
  polled_ = now;
  collect_emergencies();
  watch_heartbeat(now);
  watch_power_stage(now);
  sequence_.poll(now);
  run_phase(now);
  send_target();
}

HostTime CyclicAxis::next_deadline() const {
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

void CyclicAxis::run_phase(HostTime now) {
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
    case Phase::Loading:
      return enter(Phase::Loaded, now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Braking:
      return poll_braking(now);
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

void CyclicAxis::bring_up(HostTime now) {
  configured_ = false;
  fault_text_.clear();
  bring_up_since_ = now;
  enter(Phase::Probing, now);
  probe(now);
}

void CyclicAxis::probe(HostTime now) {
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

// A drive that is still booting does not answer: asked again until the time for bring-up is over.
void CyclicAxis::poll_probing(HostTime now) {
  if (sequence_.running()) return;
  if (sequence_.state() == SdoSequence::State::Done) {
    identity_ = {};
    enter(Phase::Configuring, now);
    return sequence_.start(cyclic_bring_up_steps(parameters_, node_.id(), identity_), now);
  }
  if (now - bring_up_since_ <= parameters_.bring_up_timeout) return probe(now);
  go_offline(
      fmt::format("no drive answers within {:.1f} s. Check its power, the cable and its termination, the "
                  "node id (node_id in the configuration, switches on the drive) and the bit rate",
                  seconds(parameters_.bring_up_timeout)),
      now);
}

void CyclicAxis::poll_configuring(HostTime now) {
  if (!sequence_done(now)) return;
  enter(Phase::StartingNode, now);
  node_.send_nmt(canopen::NmtCommand::Start);
}

// The first statusword shows that PDOs flow. A drive may come up enabled or in fault from an earlier life of
// the host.
void CyclicAxis::poll_starting_node(HostTime now) {
  if (telemetry_.status_time <= phase_since_) {
    if (expired(now, kStateTimeout)) fail("no PDO arrives from the drive after NMT start", now);
    return;
  }
  configured_ = true;
  setpoints_.rest(telemetry_.position);
  const bool faulted = telemetry_.statusword.state() == cia402::State::Fault;
  enter(faulted ? Phase::Resetting : Phase::Disabling, now);
}

// ---- power stage

void CyclicAxis::enable(HostTime now) {
  if (phase_ != Phase::Disabled) return;
  enter(Phase::SelectingMode, now);
  const auto select = canopen::sdo_write<std::int8_t>(object::kModeOfOperation, kMode);
  sequence_.start({SdoSequence::write(select), read_mode()}, now);
}

SdoSequence::Step CyclicAxis::read_mode() {
  return SdoSequence::read(object::kModeDisplay, [this](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    telemetry_.mode = r.as_i8();
    return std::nullopt;
  });
}

void CyclicAxis::poll_selecting_mode(HostTime now) {
  if (!sequence_done(now)) return;
  if (telemetry_.mode == kMode) {
    setpoints_.restart();
    enter(Phase::Enabling, now);
  } else if (expired(now, kStateTimeout)) {
    fail(fmt::format("mode 8 was selected but the drive shows mode {} (0x6061)", telemetry_.mode), now);
  } else {
    sequence_.start({read_mode()}, now);
  }
}

// Until the power stage goes on, the target is where the axis is; then it stays there.
void CyclicAxis::poll_enabling(HostTime now) {
  const bool told_to_enable =
      controlword_.sent_at() >= phase_since_ && controlword_.word() == cia402::controlword::kEnableOperation;
  if (!told_to_enable) rest_counts_ = telemetry_.position;
  setpoints_.rest(rest_counts_);
  if (!walk_to(cia402::State::OperationEnabled, now)) return;
  if (telemetry_.statusword.follows_command()) return enter(Phase::Ready, now);
  if (expired(now, kStateTimeout)) {
    fail(fmt::format("the drive is enabled but does not follow its target position (bit 12); statusword: {}",
                     telemetry_.statusword.text()),
         now);
  }
}

void CyclicAxis::disable(HostTime now) {
  if (phase_ == Phase::Ready) enter(Phase::Disabling, now);
}

void CyclicAxis::poll_disabling(HostTime now) {
  if (walk_to(cia402::State::SwitchOnDisabled, now)) enter(Phase::Disabled, now);
}

void CyclicAxis::reset_fault(HostTime now) {
  if (phase_ != Phase::Fault && phase_ != Phase::Offline) return;
  fault_text_.clear();
  if (!configured_) return bring_up(now);
  enter(Phase::Resetting, now);
}

void CyclicAxis::poll_resetting(HostTime now) {
  if (controlword_.reset(telemetry_.statusword.state(), telemetry_.status_time, phase_since_, now)) {
    error_code_ = 0;
    error_text_.clear();
    return enter(Phase::Disabled, now);
  }
  if (expired(now, kStateTimeout)) fail("the fault cannot be reset: " + drive_fault(), now);
}

/// Sends the controlwords that lead to `target`; true once the drive is there.
bool CyclicAxis::walk_to(cia402::State target, HostTime now) {
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

bool CyclicAxis::sequence_done(HostTime now) {
  if (sequence_.state() == SdoSequence::State::Failed) fail(sequence_.failure(), now);
  return sequence_.state() == SdoSequence::State::Done;
}

// ---- what the drive tells

void CyclicAxis::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  if (!telemetry_.take(number, frame, time, master_.last_sync_time())) return;
  const auto& transmission = parameters_.transmission;
  feedback_.time = telemetry_.position_time;
  feedback_.position = transmission.joint_position(telemetry_.position);
  feedback_.velocity = transmission.joint_velocity(telemetry_.velocity * parameters_.velocity_unit);
}

void CyclicAxis::collect_emergencies() {
  while (auto emcy = node_.take_emcy()) {
    if (emcy->code == cia402::emergency_code::kReset) continue;
    error_code_ = emcy->code;
    error_text_ = text_of(*emcy);
  }
}

void CyclicAxis::watch_heartbeat(HostTime now) {
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
        "the drive has restarted (boot-up message): it lost its power or was reset, and with it its settings",
        now);
  }
}

bool CyclicAxis::must_be_enabled() const {
  switch (phase_) {
    case Phase::Ready:
    case Phase::Loading:
    case Phase::Loaded:
    case Phase::Moving:
    case Phase::Braking:
      return true;
    default:
      return false;
  }
}

void CyclicAxis::watch_power_stage(HostTime now) {
  const cia402::State state = telemetry_.statusword.state();
  const bool faulted = state == cia402::State::Fault || state == cia402::State::FaultReactionActive;
  if (phase_ == Phase::Disabled && faulted) return fail(drive_fault(), now);
  if (!must_be_enabled() || state == cia402::State::OperationEnabled) return;
  fail(faulted ? drive_fault()
               : fmt::format("the drive left operation enabled by itself; statusword: {}",
                             telemetry_.statusword.text()),
       now);
}

std::string CyclicAxis::drive_fault() const {
  std::string text = fmt::format("the drive is in {}", cia402::to_text(telemetry_.statusword.state()));
  if (!error_text_.empty()) text += ": " + error_text_;
  return text;
}

// ---- results

void CyclicAxis::enter(Phase phase, HostTime now) {
  phase_ = phase;
  phase_since_ = now;
}

std::string CyclicAxis::who() const { return fmt::format("Joint {} ({})", parameters_.joint, node_.name()); }

std::string CyclicAxis::description() const {
  return fmt::format("{}: {}, serial number {}, a target position each {:.0f} ms", who(),
                     cia402::describe_identity(identity_), identity_.serial,
                     seconds(parameters_.sync_period) * 1e3);
}

/// A drive that is still enabled is told to brake by its quick stop.
void CyclicAxis::fail(const std::string& reason, HostTime now) {
  fault_text_ = fmt::format("{}: {}.", who(), reason);
  sequence_.cancel();
  const bool obeys = telemetry_.statusword.state() == cia402::State::OperationEnabled;
  if (obeys) controlword_.send(cia402::controlword::kQuickStop, now);
  enter(Phase::Fault, now);
}

void CyclicAxis::go_offline(const std::string& reason, HostTime now) {
  fail(reason, now);
  configured_ = false;
  enter(Phase::Offline, now);
}

double CyclicAxis::rest_position() const {
  return parameters_.transmission.joint_position(must_be_enabled() ? rest_counts_ : telemetry_.position);
}

void CyclicAxis::status(HostTime now, AxisStatus& out) const {
  const auto& transmission = parameters_.transmission;
  const HostDuration ahead = setpoints_.newest() - now;
  const bool streams = wants_targets() && ahead > 0ns;
  out.online = phase_ != Phase::Offline && phase_ != Phase::Probing;
  out.state = std::string(cia402::to_text(telemetry_.statusword.state()));
  out.statusword = telemetry_.statusword.raw;
  out.mode = telemetry_.mode;
  out.demand_position = transmission.joint_position(telemetry_.position_demand);
  out.following_error = telemetry_.following_error / transmission.counts_per_radian();
  out.error_code = error_code_;
  out.error_text = error_text_;
  out.capacity = 1;
  out.fill = streams ? 1 : 0;
  out.fill_time = streams ? seconds(ahead) : 0.0;
  out.underflow_warning = out.overflow_warning = false;
  out.velocity_warning = out.acceleration_warning = false;
  out.underruns = static_cast<std::uint32_t>(setpoints_.missed());
  out.overflows = 0;
  out.refused_writes = static_cast<std::uint32_t>(refused_);
  out.records_sent = sent_;
  out.clock_error_ppm = 0.0;
}

AxisReport CyclicAxis::report() const {
  const auto missed = static_cast<std::uint32_t>(setpoints_.missed() - missed_at_load_);
  return {sent_ - sent_at_load_, missed == 0 ? 1U : 0U, missed};
}

}  // namespace interpolated_motion::axis
