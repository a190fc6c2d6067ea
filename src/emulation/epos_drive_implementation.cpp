#include "epos_drive_implementation.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Function codes of the predefined connection set (CiA 301).
constexpr std::uint32_t kNmt = 0x000;
constexpr std::uint32_t kSync = 0x080;
constexpr std::uint32_t kSdoResponse = 0x580;
constexpr std::uint32_t kSdoRequest = 0x600;
constexpr std::uint32_t kErrorControl = 0x700;

constexpr std::size_t kResponses = 32;
constexpr std::int64_t kInvalidCobId = std::int64_t{1} << 31;
constexpr std::uint16_t kPdoLengthError = 0x8210;

const EposParameters& validated(const EposParameters& parameters) {
  validate(parameters);
  return parameters;
}

}  // namespace

EposDrive::Implementation::Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                                          const EposParameters& parameters, HostTime now)
    : parameters_(validated(parameters)),
      bus_(bus),
      port_(bus.add_port(listener)),
      now_(now),
      power_event_(now),
      clock_(parameters_, now),
      objects_(parameters_),
      sdo_(*this),
      pdo_(objects_, parameters_.pdo_setup_only_pre_operational, *this),
      ip_(parameters_),
      plant_(parameters.plant, parameters.initial_position) {
  power_up(now);
}

EposCounters EposDrive::Implementation::counters() const {
  EposCounters counters = counters_;
  counters.underflows = ip_.underflows();
  counters.overflows = ip_.overflows();
  counters.minimum_fill = ip_.minimum_fill();
  return counters;
}

void EposDrive::Implementation::power_up(HostTime now) {
  power_ = Power::Booting;
  power_event_ = now + parameters_.boot_time;
  nmt_.restart();
  responses_.clear();
  update_connection(now);
}

void EposDrive::Implementation::finish_boot(HostTime now) {
  power_ = Power::On;
  milliseconds_ = 0;
  clock_.restart(now + parameters_.tick_phase);
  device_.reset();
  errors_ = ErrorStore();
  ip_.reset();
  start_requested_ = ip_bit_ = halt_ = halted_ = connection_error_ = false;
  window_ms_ = 0;
  plant_.stand();
  demand_ = {plant_.position(), 0.0, 0.0};
  load_stored(false);
  nmt_.boot();
  apply_communication_parameters();
  update_limits();
  publish_motion();
  publish_errors();
  update_connection(now);
  send_state(static_cast<std::uint8_t>(NmtState::BootUp));
}

void EposDrive::Implementation::reset_communication() {
  nmt_.restart();
  sdo_.reset();
  responses_.clear();
  load_stored(true);
}

void EposDrive::Implementation::update_connection(HostTime now) {
  bus_.connect(port_, power_ == Power::On && !silent_, now);
}

void EposDrive::Implementation::power_cycle(HostTime now, HostDuration off) {
  power_ = Power::Off;
  power_event_ = off > kNever - now ? kNever : now + off;
  if (!parameters_.position_survives_power_off) plant_.place(0.0);
  plant_.stand();
  update_connection(now);
}

void EposDrive::Implementation::silence(bool silent, HostTime now) {
  silent_ = silent;
  update_connection(now);
}

void EposDrive::Implementation::set_clock_error(double ppm) { clock_.set_error(ppm); }

HostTime EposDrive::Implementation::next_event() const {
  if (power_ != Power::On) return power_event_;
  const HostTime sample = clock_.next_sample();
  return responses_.empty() ? sample : std::min(sample, responses_.front().due);
}

void EposDrive::Implementation::process(HostTime now) {
  now_ = now;
  if (power_ == Power::Off && power_event_ <= now) power_up(power_event_);
  if (power_ == Power::Booting && power_event_ <= now) finish_boot(power_event_);
  if (power_ != Power::On) return;
  while (!responses_.empty() && responses_.front().due <= now) {
    transmit(responses_.front().frame);
    responses_.pop_front();
  }
  while (power_ == Power::On && clock_.next_sample() <= now) {
    now_ = clock_.next_sample();
    clock_.take_sample();
    sample();
  }
}

bool EposDrive::Implementation::transmit(const canopen::Frame& frame) {
  if (silent_) return true;
  const bool taken = bus_.send(port_, frame, now_);
  if (!taken) ++counters_.lost_frames;
  return taken;
}

void EposDrive::Implementation::send_state(std::uint8_t state) {
  canopen::Frame frame;
  frame.id = kErrorControl + parameters_.node_id;
  frame.length = 1;
  frame.data[0] = state;
  transmit(frame);
}

void EposDrive::Implementation::send_emergency_bytes(const EmergencyBytes& bytes) {
  const std::int64_t cob_id = objects_.get(kObject<0x1014, 0>);
  const bool silenced = nmt_.state() == NmtState::Stopped || !nmt_.communicating();
  if (power_ != Power::On || silenced || (cob_id & kInvalidCobId) != 0) return;
  canopen::Frame frame;
  frame.id = static_cast<std::uint32_t>(cob_id & 0x7FF);
  frame.length = 8;
  frame.data = bytes;
  transmit(frame);
}

void EposDrive::Implementation::emergency(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  if (power_ != Power::On) return;
  now_ = std::max(now_, now);
  ++counters_.emergencies;
  send_emergency_bytes(errors_.raise(code, error_register));
  publish_errors();
}

void EposDrive::Implementation::fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  if (power_ != Power::On) return;
  emergency(code, error_register, now);
  stop_interpolation();
  device_.fault(option_codes());
  publish_status();
}

void EposDrive::Implementation::on_frame(const canopen::Frame& frame, HostTime time) {
  if (power_ != Power::On || silent_ || frame.extended || !nmt_.communicating()) return;
  now_ = time;
  const std::uint32_t node = parameters_.node_id;
  if (frame.id == kNmt) return on_nmt(frame);
  if (frame.id == kSdoRequest + node) return on_sdo(frame);
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

void EposDrive::Implementation::on_sync(HostTime time) {
  clock_.latch(time);
  pdo_.on_sync();
}

void EposDrive::Implementation::on_nmt(const canopen::Frame& frame) {
  const bool for_us = frame.data[1] == 0 || frame.data[1] == parameters_.node_id;
  if (frame.remote || frame.length != 2 || !for_us) return;
  switch (nmt_.command(frame.data[0])) {
    case NmtAction::None:
      break;
    case NmtAction::Entered:
      sdo_.reset();
      if (nmt_.operational()) enter_operational();
      break;
    case NmtAction::ResetNode:
      power_up(now_);
      break;
    case NmtAction::ResetCommunication:
      reset_communication();
      break;
  }
  publish_status();
}

void EposDrive::Implementation::enter_operational() {
  clock_.forget_reference();
  pdo_.start();
}

bool EposDrive::Implementation::sdo_allowed() const {
  return nmt_.state() == NmtState::PreOperational || nmt_.state() == NmtState::Operational;
}

void EposDrive::Implementation::on_sdo(const canopen::Frame& frame) {
  if (frame.remote || frame.length != 8 || !sdo_allowed()) return;
  if (const auto response = sdo_.on_request(frame.data)) respond(*response);
}

void EposDrive::Implementation::respond(const SdoServer::Bytes& bytes) {
  if (responses_.size() >= kResponses) {
    ++counters_.lost_frames;
    return;
  }
  canopen::Frame frame;
  frame.id = kSdoResponse + parameters_.node_id;
  frame.length = 8;
  frame.data = bytes;
  responses_.push_back({now_ + parameters_.sdo_response_time, frame});
}

void EposDrive::Implementation::on_error_control(const canopen::Frame& frame) {
  const auto node = static_cast<std::uint8_t>(frame.id - kErrorControl);
  if (frame.remote) {
    if (node == parameters_.node_id) send_state(nmt_.guard(milliseconds_));
    return;
  }
  if (frame.length != 1 || !nmt_.on_heartbeat(node, milliseconds_)) return;
  if (connection_error_ && device_.state() != DeviceState::Fault &&
      device_.state() != DeviceState::FaultReaction) {
    connection_error_ = false;
    send_emergency_bytes(errors_.reset());
    publish_errors();
  }
}

void EposDrive::Implementation::pdo_too_short() {
  emergency(kPdoLengthError, parameters_.communication_error_register, now_);
}

bool EposDrive::Implementation::pdo_send(const canopen::Frame& frame) { return transmit(frame); }

}  // namespace interpolated_motion::emulation
