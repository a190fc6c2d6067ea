#include "interpolated_motion_driver/emulation/canopen/canopen_node.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Function codes of the predefined connection set (CiA 301).
constexpr std::uint32_t kNmt = 0x000;
constexpr std::uint32_t kSync = 0x080;
constexpr std::uint32_t kErrorControl = 0x700;
constexpr std::uint32_t kTime = 0x100;  // 0x1012 as delivered

constexpr std::uint16_t kConnectionError = 0x8130;
constexpr std::uint16_t kPdoLengthError = 0x8210;

}  // namespace

CanopenNode::CanopenNode(transport::VirtualCanBus& bus, transport::CanListener& listener,
                         const NodeSettings& settings, ObjectDictionary& objects, HostTime now)
    : settings_(settings),
      objects_(objects),
      now_(now),
      power_event_(now),
      port_(bus, listener),
      clock_(settings.clock, now),
      emergencies_(objects, nmt_, port_),
      pdo_(objects, settings.pdo_setup_only_pre_operational, *this),
      communication_(objects, nmt_, pdo_, emergencies_, clock_),
      access_(objects, settings.device_name, communication_, *this),
      sdo_(access_, port_, settings.node_id, settings.sdo_response_time) {
  power_up(now);
}

void CanopenNode::power_up(HostTime now) {
  power_ = Power::Booting;
  power_event_ = now + settings_.boot_time;
  nmt_.restart();
  sdo_.restart();
  port_.set_powered(false, now);
}

void CanopenNode::finish_boot(HostTime now) {
  power_ = Power::On;
  clock_.restart(now + settings_.sample_phase);
  emergencies_.restart();
  objects_.restore(initial_values());
  nmt_.boot();
  communication_.apply();
  emergencies_.publish();
  booted();
  publish_status();
  port_.set_powered(true, now);
  send_state(static_cast<std::uint8_t>(NmtState::BootUp));
}

void CanopenNode::power_cycle(HostTime now, HostDuration off) {
  power_ = Power::Off;
  power_event_ = off > kNever - now ? kNever : now + off;
  powered_off();
  port_.set_powered(false, now);
}

HostTime CanopenNode::next_event() const {
  return on() ? std::min(clock_.next_sample(), sdo_.next_response()) : power_event_;
}

void CanopenNode::process(HostTime now) {
  now_ = now;
  if (power_ == Power::Off && power_event_ <= now) power_up(power_event_);
  if (power_ == Power::Booting && power_event_ <= now) finish_boot(power_event_);
  if (!on()) return;
  sdo_.send_due(now);
  while (on() && clock_.next_sample() <= now) {
    now_ = clock_.next_sample();
    clock_.take_sample();
    run_sample();
  }
}

void CanopenNode::run_sample() {
  if (!nmt_.communicating()) boot_nmt();
  watch_connections();
  sample();
  publish_status();
  const std::int64_t now_ms = clock_.milliseconds();
  if (nmt_.heartbeat_due(now_ms)) send_state(static_cast<std::uint8_t>(nmt_.state()));
  if (nmt_.operational()) pdo_.tick(now_ms * 10);
  if (nmt_.serves_sdo()) sdo_.pump_segments(now_);
}

// After a reset of the communication.
void CanopenNode::boot_nmt() {
  nmt_.boot();
  communication_.apply();
  send_state(static_cast<std::uint8_t>(NmtState::BootUp));
}

void CanopenNode::watch_connections() {
  if (!nmt_.connection_lost(clock_.milliseconds())) return;
  emergency(kConnectionError, settings_.communication_error_register, now_);
  if (settings_.pre_operational_on_heartbeat_loss && nmt_.operational()) nmt_.enter_pre_operational();
  connection_lost();
}

void CanopenNode::send_state(std::uint8_t state) {
  canopen::Frame frame;
  frame.id = kErrorControl + settings_.node_id;
  frame.length = 1;
  frame.data[0] = state;
  port_.send(frame, now_);
}

void CanopenNode::emergency(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  if (!on()) return;
  now_ = std::max(now_, now);
  code == 0 ? emergencies_.reset(now_) : emergencies_.raise(code, error_register, now_);
}

void CanopenNode::on_frame(const canopen::Frame& frame, HostTime time) {
  if (!on() || port_.silent() || frame.extended || !nmt_.communicating()) return;
  now_ = time;
  if (frame.id == kNmt) return on_nmt(frame);
  if (frame.id == sdo_.request_id()) {
    if (nmt_.serves_sdo()) sdo_.on_request(frame, time);
    return;
  }
  if (frame.id > kErrorControl && frame.id <= kErrorControl + 127) return on_error_control(frame);
  if (frame.id == kTime && !frame.remote) return clock_.start_over(now_);
  if (nmt_.operational()) on_pdo(frame);
}

void CanopenNode::on_pdo(const canopen::Frame& frame) {
  if (frame.id == kSync) {
    if (frame.remote) return;
    clock_.latch(now_);
    pdo_.on_sync();
  } else if (frame.remote) {
    pdo_.on_remote_request(frame);
  } else {
    pdo_.on_frame(frame);
  }
}

void CanopenNode::on_nmt(const canopen::Frame& frame) {
  const bool for_us = frame.data[1] == 0 || frame.data[1] == settings_.node_id;
  if (frame.remote || frame.length != 2 || !for_us) return;
  switch (nmt_.command(frame.data[0])) {
    case NmtAction::None:
      break;
    case NmtAction::Entered:
      entered_state();
      break;
    case NmtAction::ResetNode:
      return power_up(now_);
    case NmtAction::ResetCommunication:
      reset_communication();
      break;
  }
  publish_status();
}

void CanopenNode::entered_state() {
  sdo_.reset();
  if (!nmt_.operational()) return;
  clock_.forget_reference();
  pdo_.start();
}

void CanopenNode::reset_communication() {
  nmt_.restart();
  sdo_.restart();
  communication_.restore(initial_values());
}

void CanopenNode::on_error_control(const canopen::Frame& frame) {
  const auto node = static_cast<std::uint8_t>(frame.id - kErrorControl);
  const std::int64_t now_ms = clock_.milliseconds();
  if (!frame.remote) {
    if (frame.length == 1 && nmt_.on_heartbeat(node, now_ms)) heartbeat_heard();
  } else if (node == settings_.node_id) {
    send_state(nmt_.guard(now_ms));
  }
}

void CanopenNode::pdo_too_short() {
  emergency(kPdoLengthError, settings_.communication_error_register, now_);
}

}  // namespace interpolated_motion::emulation
