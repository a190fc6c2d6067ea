#include "interpolated_motion_driver/emulation/canopen/canopen_node.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Function codes of the predefined connection set (CiA 301).
constexpr std::uint32_t kNmt = 0x000;
constexpr std::uint32_t kSync = 0x080;
constexpr std::uint32_t kSdoResponse = 0x580;
constexpr std::uint32_t kSdoRequest = 0x600;
constexpr std::uint32_t kErrorControl = 0x700;

constexpr std::int64_t kInvalidCobId = std::int64_t{1} << 31;
constexpr std::uint16_t kConnectionError = 0x8130;

constexpr std::size_t kResponses = 32;
// Segments of a block upload sent in one sample: leaves room in the transmit queue for PDOs.
constexpr int kSegmentsPerSample = 8;

}  // namespace

CanopenNode::CanopenNode(transport::VirtualCanBus& bus, transport::CanListener& listener,
                         const NodeSettings& settings, ObjectDictionary& objects, HostTime now)
    : settings_(settings),
      bus_(bus),
      port_(bus.add_port(listener)),
      objects_(objects),
      now_(now),
      power_event_(now),
      clock_(settings.clock, now),
      sdo_(*this),
      pdo_(objects, settings.pdo_setup_only_pre_operational, *this) {
  power_up(now);
}

void CanopenNode::power_up(HostTime now) {
  power_ = Power::Booting;
  power_event_ = now + settings_.boot_time;
  nmt_.restart();
  sdo_.reset();
  responses_.clear();
  update_connection(now);
}

void CanopenNode::finish_boot(HostTime now) {
  power_ = Power::On;
  clock_.restart(now + settings_.sample_phase);
  errors_ = ErrorStore();
  objects_.restore(initial_values());
  nmt_.boot();
  apply_communication();
  publish_errors();
  booted();
  publish_status();
  update_connection(now);
  send_state(static_cast<std::uint8_t>(NmtState::BootUp));
}

void CanopenNode::update_connection(HostTime now) { bus_.connect(port_, on() && !silent_, now); }

void CanopenNode::power_cycle(HostTime now, HostDuration off) {
  power_ = Power::Off;
  power_event_ = off > kNever - now ? kNever : now + off;
  powered_off();
  update_connection(now);
}

void CanopenNode::silence(bool silent, HostTime now) {
  silent_ = silent;
  update_connection(now);
}

void CanopenNode::set_clock_error(double ppm) { clock_.set_error(ppm); }

std::int64_t CanopenNode::milliseconds() const {
  return clock_.samples() * settings_.clock.sample_period / std::chrono::milliseconds(1);
}

HostTime CanopenNode::next_event() const {
  if (!on()) return power_event_;
  const HostTime sample = clock_.next_sample();
  return responses_.empty() ? sample : std::min(sample, responses_.front().due);
}

void CanopenNode::process(HostTime now) {
  now_ = now;
  if (power_ == Power::Off && power_event_ <= now) power_up(power_event_);
  if (power_ == Power::Booting && power_event_ <= now) finish_boot(power_event_);
  if (!on()) return;
  while (!responses_.empty() && responses_.front().due <= now) {
    transmit(responses_.front().frame);
    responses_.pop_front();
  }
  while (on() && clock_.next_sample() <= now) {
    now_ = clock_.next_sample();
    clock_.take_sample();
    run_sample();
  }
}

void CanopenNode::run_sample() {
  if (!nmt_.communicating()) {
    nmt_.boot();
    apply_communication();
    send_state(static_cast<std::uint8_t>(NmtState::BootUp));
  }
  watch_connections();
  sample();
  publish_status();
  if (nmt_.heartbeat_due(milliseconds())) send_state(static_cast<std::uint8_t>(nmt_.state()));
  if (nmt_.operational()) pdo_.tick(milliseconds() * 10);
  pump_segments();
}

void CanopenNode::watch_connections() {
  if (!nmt_.connection_lost(milliseconds())) return;
  emergency(kConnectionError, settings_.communication_error_register, now_);
  if (settings_.pre_operational_on_heartbeat_loss && nmt_.operational()) nmt_.enter_pre_operational();
  connection_lost();
}

bool CanopenNode::transmit(const canopen::Frame& frame) {
  if (silent_) return true;
  const bool taken = bus_.send(port_, frame, now_);
  if (!taken) ++lost_frames_;
  return taken;
}

void CanopenNode::send_state(std::uint8_t state) {
  canopen::Frame frame;
  frame.id = kErrorControl + settings_.node_id;
  frame.length = 1;
  frame.data[0] = state;
  transmit(frame);
}

void CanopenNode::send_emergency_bytes(const EmergencyBytes& bytes) {
  const std::int64_t cob_id = value(0x1014, 0);
  const bool silenced = nmt_.state() == NmtState::Stopped || !nmt_.communicating();
  if (!on() || silenced || (cob_id & kInvalidCobId) != 0) return;
  canopen::Frame frame;
  frame.id = static_cast<std::uint32_t>(cob_id & 0x7FF);
  frame.length = 8;
  frame.data = bytes;
  transmit(frame);
}

void CanopenNode::emergency(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  if (!on()) return;
  now_ = std::max(now_, now);
  ++emergencies_;
  send_emergency_bytes(errors_.raise(code, error_register));
  publish_errors();
}

void CanopenNode::reset_errors() {
  send_emergency_bytes(errors_.reset());
  publish_errors();
}

void CanopenNode::on_frame(const canopen::Frame& frame, HostTime time) {
  if (!on() || silent_ || frame.extended || !nmt_.communicating()) return;
  now_ = time;
  if (frame.id == kNmt) return on_nmt(frame);
  if (frame.id == kSdoRequest + settings_.node_id) return on_sdo(frame);
  if (frame.id > kErrorControl && frame.id <= kErrorControl + 127) return on_error_control(frame);
  if (!nmt_.operational()) return;
  if (frame.id == kSync) {
    if (!frame.remote) on_sync(time);
  } else if (frame.remote) {
    pdo_.on_remote_request(frame);
  } else {
    pdo_.on_frame(frame);
  }
}

void CanopenNode::on_sync(HostTime time) {
  clock_.latch(time);
  pdo_.on_sync();
}

void CanopenNode::on_nmt(const canopen::Frame& frame) {
  const bool for_us = frame.data[1] == 0 || frame.data[1] == settings_.node_id;
  if (frame.remote || frame.length != 2 || !for_us) return;
  switch (nmt_.command(frame.data[0])) {
    case NmtAction::None:
      break;
    case NmtAction::Entered:
      sdo_.reset();
      if (nmt_.operational()) enter_operational();
      break;
    case NmtAction::ResetNode:
      return power_up(now_);
    case NmtAction::ResetCommunication:
      nmt_.restart();
      sdo_.reset();
      responses_.clear();
      restore_communication();
      break;
  }
  publish_status();
}

void CanopenNode::enter_operational() {
  clock_.forget_reference();
  pdo_.start();
}

bool CanopenNode::sdo_allowed() const {
  return nmt_.state() == NmtState::PreOperational || nmt_.state() == NmtState::Operational;
}

void CanopenNode::on_sdo(const canopen::Frame& frame) {
  if (frame.remote || frame.length != 8 || !sdo_allowed()) return;
  if (const auto response = sdo_.on_request(frame.data)) respond(*response);
}

void CanopenNode::respond(const SdoServer::Bytes& bytes) {
  if (responses_.size() >= kResponses) {
    ++lost_frames_;
    return;
  }
  canopen::Frame frame;
  frame.id = kSdoResponse + settings_.node_id;
  frame.length = 8;
  frame.data = bytes;
  responses_.push_back({now_ + settings_.sdo_response_time, frame});
}

void CanopenNode::pump_segments() {
  if (!sdo_allowed()) return;
  for (int i = 0; i < kSegmentsPerSample && bus_.free_slots(port_) > 1; ++i) {
    const auto segment = sdo_.next_segment();
    if (!segment) return;
    respond(*segment);
  }
}

void CanopenNode::on_error_control(const canopen::Frame& frame) {
  const auto node = static_cast<std::uint8_t>(frame.id - kErrorControl);
  if (!frame.remote) {
    if (frame.length == 1 && nmt_.on_heartbeat(node, milliseconds())) heartbeat_heard();
  } else if (node == settings_.node_id) {
    send_state(nmt_.guard(milliseconds()));
  }
}

}  // namespace interpolated_motion::emulation
