#include "interpolated_motion_driver/axis/cia402/controlword_link.h"

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"

namespace interpolated_motion::axis {

namespace cw = cia402::controlword;

void ControlwordLink::send(std::uint16_t word, HostTime now) {
  std::uint8_t data[2];
  canopen::put_le(data, word);
  if (!node_.send_rpdo(rpdo_, data, sizeof(data))) return;
  const std::uint64_t confirmed = node_.rpdos_confirmed(rpdo_);
  const bool last_is_lost = overdue(now);
  due_ = (last_is_lost ? confirmed : std::max(due_, confirmed)) + 1;
  word_ = word;
  sent_at_ = now;
}

bool ControlwordLink::applied() const {
  return node_.rpdos_confirmed(rpdo_) >= due_ && master_.last_sync_time() > node_.last_rpdo_time(rpdo_);
}

ControlwordLink::Progress ControlwordLink::walk(cia402::State current, cia402::State target, HostTime since,
                                                HostTime now) {
  using Kind = cia402::ControlStep::Kind;
  const cia402::ControlStep step = cia402::next_controlword(current, target);
  if (step.kind == Kind::Arrived) return Progress::Arrived;
  if (step.kind == Kind::NeedsFaultReset) return Progress::NeedsFaultReset;
  const bool unsent = sent_at_ < since || word_ != step.controlword;
  if (step.kind == Kind::Send && (unsent || overdue(now))) send(step.controlword, now);
  return Progress::UnderWay;
}

bool ControlwordLink::reset(cia402::State current, HostTime status_time, HostTime since, HostTime now) {
  if (sent_at_ < since) {
    send(cw::kDisableVoltage, now);
    return false;
  }
  const bool fresh = applied() && status_time > master_.last_sync_time();
  if (!fresh) {
    if (overdue(now)) send(word_, now);
    return false;
  }
  if (current == cia402::State::SwitchOnDisabled) return true;
  if (overdue(now)) {
    send(word_ == cw::kFaultReset ? cw::kDisableVoltage : cw::kFaultReset, now);
  } else if (word_ == cw::kDisableVoltage && current == cia402::State::Fault) {
    send(cw::kFaultReset, now);
  }
  return false;
}

}  // namespace interpolated_motion::axis
