#include "interpolated_motion_driver/axis/cia402/cia402_axis.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::SdoResult;

Cia402Axis::Cia402Axis(const Settings& settings, canopen::Master& master, canopen::NodeLink& node)
    : AxisBase({settings.joint, settings.bring_up_timeout}),
      settings_(settings),
      master_(master),
      node_(node),
      sequence_(node),
      controlword_(master, node, settings_.controlword_rpdo) {}

// ---- polling

void Cia402Axis::listen(HostTime now) {
  collect_emergencies();
  watch_heartbeat(now);
  watch_power_stage(now);
}

void Cia402Axis::go_on(HostDuration, HostTime now) { sequence_.poll(now); }

void Cia402Axis::poll_stage(HostTime now) {
  switch (stage()) {
    case Stage::Configuring:
      return by_pdo_ ? poll_reports(now) : poll_configuring(now);
    case Stage::Enabling:
      return by_pdo_ ? poll_enabling(now) : poll_selecting_mode(now);
    case Stage::Enabled:
      return poll_enabled(now);
    case Stage::Disabling:
      return poll_disabling(now);
    case Stage::Resetting:
      return poll_resetting(now);
    default:
      return;
  }
}

// ---- bring-up

void Cia402Axis::probe(HostTime now) {
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

std::optional<bool> Cia402Axis::probe_answer() const {
  if (sequence_.running()) return std::nullopt;
  return sequence_.state() == SdoSequence::State::Done;
}

std::string Cia402Axis::no_answer_text() const {
  return ". Check its power, the cable and its termination, the node id (node_id in the configuration, "
         "switches on the drive) and the bit rate";
}

void Cia402Axis::configure(HostTime now) {
  by_pdo_ = false;
  sequence_.start(bring_up_steps(), now);
}

void Cia402Axis::poll_configuring(HostTime now) {
  if (!sequence_done(now)) return;
  by_pdo_ = true;
  begin_phase(now);
  node_.send_nmt(canopen::NmtCommand::Start);
}

// The first statusword shows that PDOs flow. A drive may come up enabled or in fault from an earlier life of
// the host.
void Cia402Axis::poll_reports(HostTime now) {
  if (!has_reported(since())) {
    if (expired(now, kStateTimeout)) fail("no PDO arrives from the drive after NMT start", now);
    return;
  }
  configured_ = true;
  on_started();
  const bool faulted = drive().statusword.state() == cia402::State::Fault;
  enter(faulted ? Stage::Resetting : Stage::Disabling, now);
}

// ---- power stage

void Cia402Axis::enable(HostTime now) {
  if (stage() != Stage::Disabled) return;
  enter(Stage::Enabling, now);
  by_pdo_ = false;
  const auto mode = static_cast<std::int8_t>(settings_.mode);
  sequence_.start(
      {SdoSequence::write(canopen::sdo_write<std::int8_t>(object::kModeOfOperation, mode)), read_mode()},
      now);
}

SdoSequence::Step Cia402Axis::read_mode() {
  return SdoSequence::read(object::kModeDisplay, [this](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    drive().mode = r.as_i8();
    return std::nullopt;
  });
}

// Selecting mode 7 empties an EPOS's FIFO, so nothing may be loaded before the drive shows it.
void Cia402Axis::poll_selecting_mode(HostTime now) {
  if (!sequence_done(now)) return;
  if (drive().mode == static_cast<std::int8_t>(settings_.mode)) {
    on_mode_selected();
    by_pdo_ = true;
    begin_phase(now);
  } else if (expired(now, kStateTimeout)) {
    fail(fmt::format("mode {} was selected but the drive shows mode {} (0x6061)",
                     static_cast<int>(settings_.mode), drive().mode),
         now);
  } else {
    sequence_.start({read_mode()}, now);
  }
}

void Cia402Axis::poll_enabling(HostTime now) {
  on_enabling();
  if (!walk_to(cia402::State::OperationEnabled, now)) return;
  enter(Stage::Enabled, now);
  on_enabled(now);
}

void Cia402Axis::disable(HostTime now) {
  if (state() == AxisState::Ready) enter(Stage::Disabling, now);
}

void Cia402Axis::poll_disabling(HostTime now) {
  if (walk_to(cia402::State::SwitchOnDisabled, now)) enter(Stage::Disabled, now);
}

void Cia402Axis::reset_fault(HostTime now) {
  if (stage() == Stage::Offline || (stage() == Stage::Fault && !configured_)) return bring_up(now);
  if (stage() != Stage::Fault) return;
  forget_fault();
  enter(Stage::Resetting, now);
}

void Cia402Axis::poll_resetting(HostTime now) {
  if (controlword_.reset(drive().statusword.state(), drive().status_time, since(), now)) {
    error_code_ = 0;
    error_text_.clear();
    return enter(Stage::Disabled, now);
  }
  if (expired(now, kStateTimeout)) fail("the fault cannot be reset: " + drive_fault(), now);
}

/// Sends the controlwords that lead to `target`; true once the drive is there.
bool Cia402Axis::walk_to(cia402::State target, HostTime now) {
  using Progress = ControlwordLink::Progress;
  const cia402::Statusword statusword = drive().statusword;
  const Progress progress = controlword_.walk(statusword.state(), target, since(), now);
  if (progress == Progress::Arrived) return true;
  if (progress == Progress::NeedsFaultReset) {
    fail(drive_fault(), now);
  } else if (expired(now, kStateTimeout)) {
    fail(fmt::format("the drive does not get to \"{}\" within {:.0f} s; statusword: {}",
                     cia402::to_text(target), seconds(kStateTimeout), statusword.text()),
         now);
  }
  return false;
}

bool Cia402Axis::sequence_done(HostTime now) {
  if (sequence_.state() == SdoSequence::State::Failed) fail(sequence_.failure(), now);
  return sequence_.state() == SdoSequence::State::Done;
}

// ---- watching

void Cia402Axis::collect_emergencies() {
  while (auto emcy = node_.take_emcy()) {
    if (emcy->code == cia402::emergency_code::kReset) continue;
    error_code_ = emcy->code;
    error_text_ = text_of(*emcy);
  }
}

// A drive that has restarted has no power stage that is on, so it does not move, whatever it was doing.
void Cia402Axis::watch_heartbeat(HostTime now) {
  while (auto event = node_.heartbeat().take_event()) {
    silent_ = *event == canopen::HeartbeatEvent::Lost;
    if (stage() == Stage::Offline || stage() == Stage::Probing) continue;
    if (silent_) {
      return lose(fmt::format("no heartbeat from the drive for {:.2f} s: it is off, disconnected or stuck",
                              seconds(settings_.heartbeat_timeout)),
                  now);
    }
    if (*event != canopen::HeartbeatEvent::BootUp) continue;
    if (stage() == Stage::Configuring && !by_pdo_) return bring_up(now);
    return go_offline(
        "the drive has restarted (boot-up message): it lost its power or was reset, and with it " +
            lost_by_restart(),
        now);
  }
}

void Cia402Axis::watch_power_stage(HostTime now) {
  const cia402::Statusword statusword = drive().statusword;
  const cia402::State state = statusword.state();
  const bool faulted = state == cia402::State::Fault || state == cia402::State::FaultReactionActive;
  if (stage() == Stage::Disabled && faulted) return fail(drive_fault(), now);
  if (!enabled() || state == cia402::State::OperationEnabled) return;
  fail(faulted ? drive_fault()
               : fmt::format("the drive left operation enabled by itself; statusword: {}", statusword.text()),
       now);
}

std::string Cia402Axis::drive_fault() const {
  std::string text = fmt::format("the drive is in {}", cia402::to_text(drive().statusword.state()));
  if (!error_text_.empty()) text += ": " + error_text_;
  return text + fault_detail();
}

// ---- a fault in motion

void Cia402Axis::give_up(HostTime) { sequence_.cancel(); }

bool Cia402Axis::may_move() const {
  const cia402::State state = drive().statusword.state();
  return is_motion_phase() &&
         (obeys() || state == cia402::State::QuickStopActive || state == cia402::State::FaultReactionActive);
}

/// A drive whose power stage is off cannot move any more. In a quick stop, "target reached" means standstill.
bool Cia402Axis::stands() const {
  if (drive().status_time <= since()) return false;
  switch (drive().statusword.state()) {
    case cia402::State::OperationEnabled:
      return halted();
    case cia402::State::QuickStopActive:
      return drive().statusword.target_reached();
    case cia402::State::FaultReactionActive:
      return false;
    default:
      return true;
  }
}

std::string Cia402Axis::unseen_text() const {
  return silent_ ? "it does not answer" : "statusword: " + drive().statusword.text();
}

void Cia402Axis::fill_status(AxisStatus& out) const {
  out.online = stage() != Stage::Offline && stage() != Stage::Probing;
  out.state = std::string(cia402::to_text(drive().statusword.state()));
  out.statusword = drive().statusword.raw;
  out.mode = drive().mode;
  out.error_code = error_code_;
  out.error_text = error_text_;
}

}  // namespace interpolated_motion::axis
