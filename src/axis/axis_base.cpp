#include "interpolated_motion_driver/axis/axis_base.h"

#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

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
      return AxisState::FaultStopping;
    case Stage::Fault:
      break;
  }
  return AxisState::Fault;
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

void AxisBase::lose(const std::string& reason, HostTime now) { end_in(Stage::Offline, reason, now); }

void AxisBase::end_in(Stage stage, const std::string& reason, HostTime now) {
  if (stage_ == Stage::FaultStopping) {
    if (stage == Stage::Offline) after_stop_ = stage;
    return;
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
  if (stage_ != Stage::FaultStopping) fault_text_ = fmt::format("{}: {}.", who(), reason);
  player_->give_up(now);
  drop_work();
  enter(Stage::Offline, now);
}

/// A drive that does not answer is told again until all that it may have to play must be over and it has
/// braked by itself.
void AxisBase::poll_fault_stopping(HostTime now) {
  if (stands()) return end_fault_stopping(" The drive has come to rest.", now);
  if (now < rest_due_ || obeys_stop()) return press_stop(now);
  end_fault_stopping(
      fmt::format(
          " The drive has not been seen at rest ({}); {:.1f} s after the fault all that it had to play "
          "is over, and it has braked by itself if it still works.",
          unseen_text(), seconds(now - time_.since())),
      now);
}

void AxisBase::end_fault_stopping(const std::string& how, HostTime now) {
  fault_text_ += how;
  drop_work();
  enter(after_stop_, now);
}

}  // namespace interpolated_motion::axis
