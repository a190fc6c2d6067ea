#include "interpolated_motion_driver/axis/cia402/cia402_axis.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace object = cia402::object;
using canopen::SdoResult;

namespace {

/// How often an axis wants to be polled while it works towards something.
constexpr HostDuration kPollInterval = 5ms;
/// The same in motion, where what the drive reports is an event of its own and its FIFO lasts far longer.
constexpr HostDuration kMotionPollInterval = 10ms;
/// Polls further apart than this mean that the host was away: stopped, or starved by other programs.
constexpr HostDuration kHostStall = 100ms;

}  // namespace

Cia402Axis::Cia402Axis(Settings settings, canopen::Master& master, canopen::NodeLink& node)
    : settings_(std::move(settings)),
      master_(master),
      node_(node),
      sequence_(node),
      controlword_(master, node, settings_.controlword_rpdo) {}

AxisState Cia402Axis::state() const {
  switch (stage_) {
    case Stage::Offline:
      return AxisState::Offline;
    case Stage::Probing:
    case Stage::Configuring:
    case Stage::StartingNode:
    case Stage::Resetting:
      return AxisState::Configuring;
    case Stage::Disabled:
      return AxisState::Disabled;
    case Stage::SelectingMode:
    case Stage::Enabling:
      return AxisState::Enabling;
    case Stage::Enabled:
      return enabled_state();
    case Stage::Disabling:
      return AxisState::Stopping;
    case Stage::Fault:
      break;
  }
  return AxisState::Fault;
}

// ---- polling

void Cia402Axis::poll(HostTime now) {
  note_stall(now);
  collect_emergencies();
  watch_heartbeat(now);
  watch_power_stage(now);
  sequence_.poll(now);
  run_stage(now);
}

void Cia402Axis::note_stall(HostTime now) {
  const HostDuration away = now - polled_;
  if (away > kHostStall) {
    if (polled_ >= since_) away_ += away;
    absent_ += away;
  }
  polled_ = now;
}

void Cia402Axis::begin_phase(HostTime now) {
  since_ = now;
  away_ = HostDuration::zero();
}

HostTime Cia402Axis::next_deadline() const {
  switch (state()) {
    case AxisState::Offline:
    case AxisState::Disabled:
    case AxisState::Ready:
    case AxisState::Loaded:
    case AxisState::Fault:
      return kNever;
    case AxisState::Moving:
      return polled_ + kMotionPollInterval;
    default:
      return polled_ + kPollInterval;
  }
}

void Cia402Axis::run_stage(HostTime now) {
  switch (stage_) {
    case Stage::Probing:
      return poll_probing(now);
    case Stage::Configuring:
      return poll_configuring(now);
    case Stage::StartingNode:
      return poll_starting_node(now);
    case Stage::SelectingMode:
      return poll_selecting_mode(now);
    case Stage::Enabling:
      return poll_enabling(now);
    case Stage::Enabled:
      return poll_enabled(now);
    case Stage::Disabling:
      return poll_disabling(now);
    case Stage::Resetting:
      return poll_resetting(now);
    case Stage::Offline:
    case Stage::Disabled:
    case Stage::Fault:
      return;
  }
}

// ---- bring-up

void Cia402Axis::bring_up(HostTime now) {
  configured_ = false;
  fault_text_.clear();
  bring_up_since_ = now;
  enter(Stage::Probing, now);
  probe(now);
}

void Cia402Axis::probe(HostTime now) {
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

// A drive that is still booting does not answer: asked again until the time for bring-up is over.
void Cia402Axis::poll_probing(HostTime now) {
  if (sequence_.running()) return;
  if (sequence_.state() == SdoSequence::State::Done) {
    enter(Stage::Configuring, now);
    return sequence_.start(bring_up_steps(), now);
  }
  if (now - bring_up_since_ <= settings_.bring_up_timeout) return probe(now);
  go_offline(
      fmt::format("no drive answers within {:.1f} s. Check its power, the cable and its termination, the "
                  "node id (node_id in the configuration, switches on the drive) and the bit rate",
                  seconds(settings_.bring_up_timeout)),
      now);
}

void Cia402Axis::poll_configuring(HostTime now) {
  if (!sequence_done(now)) return;
  enter(Stage::StartingNode, now);
  node_.send_nmt(canopen::NmtCommand::Start);
}

// The first statusword shows that PDOs flow. A drive may come up enabled or in fault from an earlier life of
// the host.
void Cia402Axis::poll_starting_node(HostTime now) {
  if (!has_reported(since_)) {
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
  if (stage_ != Stage::Disabled) return;
  enter(Stage::SelectingMode, now);
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
    enter(Stage::Enabling, now);
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
  if (stage_ != Stage::Fault && stage_ != Stage::Offline) return;
  fault_text_.clear();
  if (!configured_) return bring_up(now);
  enter(Stage::Resetting, now);
}

void Cia402Axis::poll_resetting(HostTime now) {
  if (controlword_.reset(drive().statusword.state(), drive().status_time, since_, now)) {
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
  const Progress progress = controlword_.walk(statusword.state(), target, since_, now);
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

void Cia402Axis::watch_heartbeat(HostTime now) {
  while (auto event = node_.heartbeat().take_event()) {
    if (stage_ == Stage::Offline || stage_ == Stage::Probing) continue;
    if (*event == canopen::HeartbeatEvent::Lost) {
      return go_offline(
          fmt::format("no heartbeat from the drive for {:.2f} s: it is off, disconnected or stuck",
                      seconds(settings_.heartbeat_timeout)),
          now);
    }
    if (*event != canopen::HeartbeatEvent::BootUp) continue;
    if (stage_ == Stage::Configuring) return bring_up(now);
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
  if (stage_ == Stage::Disabled && faulted) return fail(drive_fault(), now);
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

// ---- results

void Cia402Axis::enter(Stage stage, HostTime now) {
  stage_ = stage;
  begin_phase(now);
}

std::string Cia402Axis::who() const { return fmt::format("Joint {} ({})", settings_.joint, node_.name()); }

void Cia402Axis::fail(const std::string& reason, HostTime now) {
  fault_text_ = fmt::format("{}: {}.", who(), reason);
  sequence_.cancel();
  give_up(now);
  enter(Stage::Fault, now);
}

void Cia402Axis::go_offline(const std::string& reason, HostTime now) {
  fail(reason, now);
  configured_ = false;
  enter(Stage::Offline, now);
}

void Cia402Axis::fill_status(AxisStatus& out) const {
  out.online = stage_ != Stage::Offline && stage_ != Stage::Probing;
  out.state = std::string(cia402::to_text(drive().statusword.state()));
  out.statusword = drive().statusword.raw;
  out.mode = drive().mode;
  out.error_code = error_code_;
  out.error_text = error_text_;
}

}  // namespace interpolated_motion::axis
