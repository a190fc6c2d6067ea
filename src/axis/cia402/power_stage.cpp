#include "interpolated_motion_driver/axis/cia402/power_stage.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::SdoResult;

namespace {

/// A drive latches its state up to 2 samples after SYNC, before or after it takes a controlword.
constexpr HostDuration kLatchTime = std::chrono::milliseconds(2);
/// A drive that has been told by PDO to stop, and has not come to rest by then, is told by SDO as well.
constexpr HostDuration kPdoPatience = std::chrono::milliseconds(200);

SdoSequence::Step read_mode(Cia402Report& report) {
  return SdoSequence::read(object::kModeDisplay, [&report](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    report.mode = r.as_i8();
    return std::nullopt;
  });
}

std::string wrong_mode_text(int mode, int wanted) {
  return fmt::format(
      "the drive is in mode {} (0x6061) instead of {}: somebody else has changed it, or the drive itself",
      mode, wanted);
}

}  // namespace

Cia402PowerStage::Cia402PowerStage(const Cia402Settings& settings, Cia402Device& device,
                                   canopen::Master& master, canopen::NodeLink& node)
    : AxisBase({settings.joint, settings.bring_up_timeout}),
      settings_(settings),
      device_(device),
      report_(device.report()),
      feedback_(device.feedback()),
      master_(master),
      node_(node),
      sequence_(node),
      controlword_(master, node, settings_.controlword_rpdo),
      watch_(master, node, settings_.heartbeat_timeout),
      sdo_stop_(sequence_, device),
      errors_(device, sequence_, notes(), [this] { return who(); }) {}

// Polling.

void Cia402PowerStage::listen(HostTime now) {
  errors_.collect(node_, now);
  watch_node(now);
  watch_power_stage(now);
}

void Cia402PowerStage::go_on(HostDuration, HostTime now) {
  sequence_.poll(now);
  watch_reports(now);
  if (!listening_) return;
  const canopen::ForeignTraffic& foreign = master_.foreign();
  const bool over = stage() != Stage::Probing || time().expired(now, settings_.bring_up_timeout);
  if (over || foreign.quiet(now)) return ask(now);
  if (watch_.other_master() && time().expired(now, 2 * foreign.patience()))
    fail(watch_.text(NodeEvent::OtherMaster, {}), now);
}

void Cia402PowerStage::poll_stage(HostTime now) {
  switch (stage()) {
    case Stage::Configuring:
      return by_pdo_ ? poll_reports(now) : poll_configuring(now);
    case Stage::Enabling:
      return by_pdo_ ? poll_enabling(now) : poll_selecting_mode(now);
    case Stage::Disabling:
      return walk_to(cia402::State::SwitchOnDisabled, now) ? enter(Stage::Disabled, now) : void();
    case Stage::Resetting:
      return poll_resetting(now);
    default:
      return;
  }
}

// Bring-up.

void Cia402PowerStage::forget_drive() {
  configured_ = false;
  watch_.forget();
}

// Whoever talks to a drive that another master moves takes it over.
void Cia402PowerStage::probe(HostTime now) {
  listening_ = !master_.foreign().quiet(now);
  if (!listening_) ask(now);
}

void Cia402PowerStage::ask(HostTime now) {
  listening_ = false;
  if (stage() != Stage::Probing) return;
  asked_ = true;
  watch_.forget();
  node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  sequence_.start({SdoSequence::read(object::kDeviceType)}, now);
}

std::optional<bool> Cia402PowerStage::probe_answer() const {
  if (listening_ || sequence_.running()) return std::nullopt;
  return sequence_.state() == SdoSequence::State::Done;
}

std::string Cia402PowerStage::no_answer_text() const {
  return ". Check its power, the cable and its termination, the node id (node_id in the configuration, "
         "switches on the drive) and the bit rate; raise sdo_timeout of the bus for one that is slow to "
         "answer";
}

void Cia402PowerStage::configure(HostTime now) {
  by_pdo_ = false;
  std::vector<SdoSequence::Step> steps = device_.bring_up_steps(sequence_);
  steps.insert(steps.begin(), errors_.read(now));
  sequence_.start(std::move(steps), now);
}

void Cia402PowerStage::poll_configuring(HostTime now) {
  if (!sequence_done(now)) return;
  by_pdo_ = true;
  time().begin(now);
  watch_.expect_operational(now);
  node_.send_nmt(canopen::NmtCommand::Start);
}

// The first statusword shows that PDOs flow. A drive may come up enabled or in fault from an earlier life of
// the host.
void Cia402PowerStage::poll_reports(HostTime now) {
  if (!device_.has_reported(time().since())) {
    if (time().expired(now, kStateTimeout)) fail("no PDO arrives from the drive after NMT start", now);
    return;
  }
  configured_ = true;
  device_.on_started();
  const bool faulted = report_.state() == cia402::State::Fault;
  if (faulted) errors_.note(true, "found in fault, which is reset now: " + drive_fault(), now);
  enter(faulted ? Stage::Resetting : Stage::Disabling, now);
}

// Power stage.

void Cia402PowerStage::enable(HostTime now) {
  if (stage() != Stage::Disabled) return;
  enter(Stage::Enabling, now);
  by_pdo_ = false;
  const auto mode = static_cast<std::int8_t>(settings_.mode);
  std::vector<SdoSequence::Step> steps = device_.enable_steps();
  steps.push_back(errors_.read(now));
  steps.push_back(SdoSequence::write(canopen::sdo_write<std::int8_t>(object::kModeOfOperation, mode)));
  steps.push_back(read_mode(report_));
  sequence_.start(std::move(steps), now);
}

// Selecting mode 7 empties an EPOS's FIFO, so nothing may be loaded before the drive shows it.
void Cia402PowerStage::poll_selecting_mode(HostTime now) {
  if (!sequence_done(now)) return;
  if (report_.mode == static_cast<std::int8_t>(settings_.mode)) {
    device_.on_mode_selected();
    by_pdo_ = true;
    time().begin(now);
  } else if (time().expired(now, kStateTimeout)) {
    fail(fmt::format("mode {} was selected but the drive shows mode {} (0x6061)",
                     static_cast<int>(settings_.mode), report_.mode),
         now);
  } else {
    sequence_.start({read_mode(report_)}, now);
  }
}

void Cia402PowerStage::poll_enabling(HostTime now) {
  const bool commanded = controlword_.sent_at() >= time().since() &&
                         controlword_.word() == cia402::controlword::kEnableOperation;
  device_.on_enabling(commanded);
  if (!walk_to(cia402::State::OperationEnabled, now)) return;
  enter(Stage::Enabled, now);
}

void Cia402PowerStage::disable(HostTime now) {
  if (state() == AxisState::Ready) return enter(Stage::Disabling, now);
  AxisBase::disable(now);
}

// By SDO: a drive that has restarted has lost the mapping of its PDOs.
std::optional<bool> Cia402PowerStage::switch_off(HostTime now) {
  if (!asked_) return false;
  if (sequence_.running()) return std::nullopt;
  if (sequence_.state() == SdoSequence::State::Failed) return false;
  if (sequence_.state() == SdoSequence::State::Done && !is_powered()) return true;
  const auto take_statusword = [this](const SdoResult& r) -> std::optional<std::string> {
    if (!r.ok) return r.text();
    report_.statusword = cia402::Statusword{r.as_u16()};
    return std::nullopt;
  };
  const std::uint16_t word = cia402::controlword::kDisableVoltage;
  sequence_.start({SdoSequence::write(canopen::sdo_write<std::uint16_t>(object::kControlword, word)),
                   SdoSequence::read(object::kStatusword, take_statusword)},
                  now);
  return std::nullopt;
}

void Cia402PowerStage::reset_fault(HostTime now) {
  const bool lost = stage() == Stage::Offline || stage() == Stage::SwitchingOff;
  if (lost || (stage() == Stage::Fault && !configured_)) return bring_up(now);
  if (stage() != Stage::Fault) return;
  enter(Stage::Resetting, now);
  by_pdo_ = false;
  std::vector<SdoSequence::Step> steps = device_.reset_steps();
  steps.insert(steps.begin(), errors_.read(now));
  sequence_.start(std::move(steps), now);
}

// Nothing is cleared that has not been read.
void Cia402PowerStage::poll_resetting(HostTime now) {
  if (!by_pdo_) {
    if (sequence_.running()) return;
    by_pdo_ = true;
    time().begin(now);
  }
  if (controlword_.reset(report_.state(), report_.status_time, time().since(), now)) {
    errors_.end(now);
    return enter(Stage::Disabled, now);
  }
  if (time().expired(now, kStateTimeout)) fail("the fault cannot be reset: " + drive_fault(), now);
}

/// Sends the controlwords that lead to `target`; true once the drive is there.
bool Cia402PowerStage::walk_to(cia402::State target, HostTime now) {
  using Progress = ControlwordLink::Progress;
  const cia402::Statusword statusword = report_.statusword;
  if (report_.status_time <= time().since()) {
    if (time().expired(now, kStateTimeout)) fail("no statusword comes from the drive", now);
    return false;
  }
  const Progress progress = controlword_.walk(statusword.state(), target, time().since(), now);
  if (progress == Progress::Arrived) return true;
  if (progress == Progress::NeedsFaultReset) {
    fail(drive_fault(), now);
  } else if (time().expired(now, kStateTimeout)) {
    fail(fmt::format("the drive does not get to \"{}\" within {:.0f} s; statusword: {}",
                     cia402::to_text(target), seconds(kStateTimeout), statusword.text()),
         now);
  }
  return false;
}

bool Cia402PowerStage::sequence_done(HostTime now) {
  const bool failed = sequence_.state() == SdoSequence::State::Failed;
  configured_ = configured_ && !failed;
  if (failed) fail(sequence_.failure(), now);
  return sequence_.state() == SdoSequence::State::Done;
}

// Watching.

// A drive that has booted while it was looked for is asked at once: the last question may have been too
// early.
void Cia402PowerStage::watch_node(HostTime now) {
  while (const auto event = watch_.next()) {
    if (*event == NodeEvent::Restarted && stage() == Stage::Probing && !listening_) ask(now);
    const bool looked_for = stage() == Stage::Offline || stage() == Stage::Probing;
    const bool meant = !looked_for || (*event == NodeEvent::OtherMaster && !listening_);
    if (meant && stage() != Stage::Offline) take(*event, now);
  }
}

// A reset of its communication makes a drive forget its PDOs and whom it listens to, and it need not stop for
// that: whether it has lost its power or goes on with what it has, its statusword tells.
void Cia402PowerStage::take(NodeEvent event, HostTime now) {
  if (event == NodeEvent::Restarted && stage() == Stage::Configuring && !by_pdo_) return bring_up(now);
  configured_ = false;
  if (event == NodeEvent::Restarted && stage() == Stage::Fault && watch_.to_restart()) return;
  std::string why = watch_.text(event, device_.lost_by_restart());
  if (event == NodeEvent::NotOperational && errors_.code() != 0) why += ", and reports " + errors_.history();
  if (event == NodeEvent::Silent) return end_in(Stage::Offline, why, now);
  if (event != NodeEvent::Restarted) return stage() == Stage::Fault ? void() : fail(why, now);
  if (stage() == Stage::FaultStopping || stage() == Stage::SwitchingOff) drop_work();
  end_in(Stage::Offline, why, now);
}

// In motion the player watches more closely.
void Cia402PowerStage::watch_reports(HostTime now) {
  const bool due = stage() == Stage::Disabled || enabled();
  if (!configured_ || !due) return;
  const HostTime known = std::min(feedback_.time, report_.status_time);
  const HostDuration patience = std::max(settings_.feedback_timeout, settings_.heartbeat_timeout);
  // Nothing was asked of the drives while the host was away, so nothing has come.
  if (now - std::max(known, time().returned()) <= patience) return;
  configured_ = false;
  fail(fmt::format("no {} has come from the drive for {:.2f} s, though its heartbeat comes: its PDOs have "
                   "been changed or switched off",
                   known == feedback_.time ? "position" : "statusword", seconds(now - known)),
       now);
}

void Cia402PowerStage::watch_power_stage(HostTime now) {
  const cia402::Statusword statusword = report_.statusword;
  const cia402::State state = report_.state();
  const bool faulted = state == cia402::State::Fault || state == cia402::State::FaultReactionActive;
  if (stage() == Stage::Disabled && faulted) return fail(drive_fault(), now);
  if (!enabled()) return;
  const auto wanted = static_cast<std::int8_t>(settings_.mode);
  if (state == cia402::State::OperationEnabled)
    return report_.mode == wanted ? void() : fail(wrong_mode_text(report_.mode, wanted), now);
  fail(faulted ? drive_fault()
               : fmt::format("the drive left operation enabled by itself; statusword: {}", statusword.text()),
       now);
}

std::string Cia402PowerStage::drive_fault() const {
  std::string text = fmt::format("the drive is in {}", cia402::to_text(report_.state()));
  if (!errors_.text().empty()) text += ": " + errors_.history();
  return text + device_.fault_detail();
}

// A fault in motion.

bool Cia402PowerStage::is_powered() const {
  const cia402::State state = report_.state();
  return state == cia402::State::OperationEnabled || state == cia402::State::QuickStopActive ||
         state == cia402::State::FaultReactionActive;
}

void Cia402PowerStage::drop_work() {
  sequence_.cancel();
  sdo_stop_.begin();
}

void Cia402PowerStage::press_stop(HostTime now) {
  const std::uint16_t word = device_.stop_word();
  // In Stopped it takes NMT commands alone.
  if (watch_.stopped() && !sequence_.running()) node_.send_nmt(canopen::NmtCommand::EnterPreOperational);
  if (!watch_.takes_pdos() || time().expired(now, kPdoPatience)) sdo_stop_.poll(word, now);
  if (!watch_.takes_pdos()) return;
  if (report_.state() != cia402::State::OperationEnabled) return;
  if (controlword_.word() == word && !controlword_.overdue(now)) return;
  controlword_.send(word, now);
  master_.request_sync(now);
}

// With halt set, "target reached" means standstill. It counts when the drive has sent it after it took the
// halt.
bool Cia402PowerStage::halted() const {
  const HostTime sync = master_.last_sync_time();
  const bool fresh = controlword_.applied() && report_.status_time > sync &&
                     sync > node_.last_rpdo_time(settings_.controlword_rpdo) + kLatchTime;
  return fresh && (controlword_.word() & cia402::controlword::kHaltBit) != 0 &&
         report_.statusword.target_reached();
}

/// A drive whose power stage is off cannot move any more. In a quick stop, "target reached" means standstill.
bool Cia402PowerStage::stands() const {
  if (report_.status_time <= time().since()) return false;
  switch (report_.state()) {
    case cia402::State::OperationEnabled:
      return halted() || sdo_stop_.halted();
    case cia402::State::QuickStopActive:
      return report_.statusword.target_reached();
    case cia402::State::FaultReactionActive:
      return false;
    default:
      return true;
  }
}

bool Cia402PowerStage::wants_targets() const {
  const bool disabling = stage() == Stage::Disabling && report_.state() == cia402::State::OperationEnabled;
  return enabled() || (stage() == Stage::Enabling && by_pdo_) || disabling;
}

std::string Cia402PowerStage::unseen_text() const {
  if (!asked_) return "nothing has been sent to it, since it has another master";
  return watch_.silent() ? "it does not answer" : "statusword: " + report_.statusword.text();
}

void Cia402PowerStage::drive_status(AxisStatus& out) const {
  out.online = is_online();
  out.state = std::string(cia402::to_text(report_.state()));
  out.statusword = report_.statusword.raw;
  out.mode = report_.mode;
  out.error_code = errors_.code();
  out.error_text = errors_.text();
}

}  // namespace interpolated_motion::axis
