#include "interpolated_motion_driver/axis/axis_base.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

namespace {

/// Longest for a drive in fault to be switched off; one that does not answer is given up then.
constexpr HostDuration kSwitchOffTimeout = std::chrono::milliseconds(1500);

}  // namespace

AxisState AxisBase::state() const {
  switch (stage_) {
    case Stage::Offline:
      return AxisState::Offline;
    case Stage::Probing:
    case Stage::Configuring:
    case Stage::Resetting:
      return AxisState::Configuring;
    case Stage::Disabled:
      return AxisState::Disabled;
    case Stage::Enabling:
      return AxisState::Enabling;
    case Stage::Enabled:
      return player_->enabled_state();
    case Stage::Disabling:
      return AxisState::Stopping;
    case Stage::FaultStopping:
    case Stage::SwitchingOff:
      return AxisState::FaultStopping;
    case Stage::Fault:
      break;
  }
  return AxisState::Fault;
}

bool AxisBase::is_online() const {
  const bool on_the_way = stage_ == Stage::FaultStopping || stage_ == Stage::SwitchingOff;
  const Stage stage = on_the_way ? after_stop_ : stage_;
  return stage != Stage::Offline && stage != Stage::Probing;
}

void AxisBase::poll(HostTime now) {
  listen(now);
  if (feedback().time != reported_) {
    reported_ = feedback().time;
    time_.note_report();
  }
  go_on(time_.poll(now), now);
  run_stage(now);
}

HostTime AxisBase::next_deadline() const {
  switch (state()) {
    case AxisState::Offline:
    case AxisState::Disabled:
    case AxisState::Ready:
    case AxisState::Loaded:
    case AxisState::Fault:
      return kNever;
    case AxisState::Moving:
      return time_.polled() + kMotionPollInterval;
    default:
      return time_.polled() + kPollInterval;
  }
}

void AxisBase::run_stage(HostTime now) {
  switch (stage_) {
    case Stage::Offline:
    case Stage::Fault:
      return;
    case Stage::Probing:
      return poll_probing(now);
    case Stage::Enabled:
      return player_->play(now);
    case Stage::FaultStopping:
      return poll_fault_stopping(now);
    case Stage::SwitchingOff:
      return poll_switching_off(now);
    default:
      return poll_stage(now);
  }
}

void AxisBase::enter(Stage stage, HostTime now) {
  stage_ = stage;
  time_.begin(now);
  if (stage == Stage::Resetting) fault_text_.clear();
  if (stage == Stage::Enabled) player_->begin(now);
}

void AxisBase::bring_up(HostTime now) {
  fault_text_.clear();
  forget_drive();
  enter(Stage::Probing, now);
  probe(now);
}

// A drive that is still booting does not answer: asked again until the time for bring-up is over.
void AxisBase::poll_probing(HostTime now) {
  const std::optional<bool> answer = probe_answer();
  if (!answer) return;
  if (*answer) {
    enter(Stage::Configuring, now);
    return configure(now);
  }
  if (!time_.expired(now, settings_.bring_up_timeout)) return probe(now);
  go_offline(fmt::format("no drive answers within {:.1f} s{}", seconds(settings_.bring_up_timeout),
                         no_answer_text()),
             now);
}

std::string AxisBase::who() const { return fmt::format("Joint {} ({})", settings_.joint, device_name()); }

void AxisBase::fail(const std::string& reason, HostTime now) { end_in(Stage::Fault, reason, now); }

void AxisBase::end_in(Stage stage, const std::string& reason, HostTime now) {
  if (stage_ == Stage::FaultStopping || stage_ == Stage::SwitchingOff) {
    if (stage == Stage::Offline) after_stop_ = stage;
    if (stage == Stage::Offline) rest_due_ = std::min(rest_due_, now + player_->longest_motion(now));
    return;
  }
  // The first cause is the one to be removed.
  if (stage_ == Stage::Fault) {
    fault_text_ += fmt::format(" Since then: {}.", reason);
    return enter(stage, now);
  }
  after_stop_ = stage;
  const bool moving = enabled() && is_powered() && player_->may_move();
  if (moving) rest_due_ = now + player_->longest_motion(now);
  fault_text_ = fmt::format("{}: {}.", who(), reason);
  player_->give_up(now);
  drop_work();
  enter(moving ? Stage::FaultStopping : stage, now);
  if (moving) press_stop(now);
}

void AxisBase::go_offline(const std::string& reason, HostTime now) {
  if (stage_ != Stage::FaultStopping && stage_ != Stage::SwitchingOff)
    fault_text_ = fmt::format("{}: {}.", who(), reason);
  player_->give_up(now);
  drop_work();
  enter(Stage::Offline, now);
}

/// A drive that does not answer is told again until all that it may have to play must be over and it has
/// braked by itself.
void AxisBase::poll_fault_stopping(HostTime now) {
  const bool rests = stands();
  if (!rests && (now < rest_due_ || obeys_stop())) return press_stop(now);
  if (rests) {
    fault_text_ += " The drive has come to rest." + cause_text();
  } else {
    fault_text_ += fmt::format(
        " The drive has not been seen at rest ({}); {:.1f} s after the fault all that it had to play "
        "is over, and it has braked by itself if it still works.",
        unseen_text(), seconds(now - time_.since()));
  }
  drop_work();
  enter(after_stop_, now);
}

// What the host has found wrong need not have switched the drive off.
void AxisBase::disable(HostTime now) {
  if (stage_ != Stage::Fault && stage_ != Stage::Offline) return;
  after_stop_ = stage_;
  drop_work();
  enter(Stage::SwitchingOff, now);
}

void AxisBase::poll_switching_off(HostTime now) {
  const std::optional<bool> off = switch_off(now);
  if (!off && !time_.expired(now, kSwitchOffTimeout)) return;
  if (!off.value_or(false)) {
    notes().add(
        {true, fmt::format("{}: the drive could not be told to switch its power stage off ({}). If it has "
                           "power, it may be on.",
                           who(), unseen_text())},
        now);
  }
  drop_work();
  enter(after_stop_, now);
}

}  // namespace interpolated_motion::axis
