#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr int kInterpolatedPositionMode = 7;

constexpr unsigned kHalt = 1U << 8;
constexpr unsigned kEnableIpMode = 1U << 4;

constexpr std::uint16_t kRemote = 1U << 9;
constexpr std::uint16_t kTargetReached = 1U << 10;
constexpr std::uint16_t kIpActive = 1U << 12;
constexpr std::uint16_t kHomed = 1U << 15;
constexpr std::int64_t kNoWindow = 0xFFFFFFFF;

const EposParameters& validated(const EposParameters& parameters) {
  validate(parameters);
  return parameters;
}

NodeSettings node_settings(const EposParameters& parameters) {
  NodeSettings settings;
  settings.node_id = parameters.node_id;
  settings.device_name = parameters.device_name;
  settings.clock.error_ppm = parameters.clock_error_ppm;
  settings.clock.discipline = parameters.clock_discipline;
  settings.clock.slew = parameters.clock_slew;
  settings.sample_phase = parameters.tick_phase;
  settings.boot_time = parameters.boot_time;
  settings.sdo_response_time = parameters.sdo_response_time;
  settings.communication_error_register = parameters.communication_error_register;
  settings.pre_operational_on_heartbeat_loss = parameters.pre_operational_on_heartbeat_loss;
  settings.pdo_setup_only_pre_operational = parameters.pdo_setup_only_pre_operational;
  return settings;
}

}  // namespace

EposDrive::Implementation::Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                                          const EposParameters& parameters, HostTime now)
    : CanopenServo(bus, listener, node_settings(validated(parameters)), objects_, now),
      parameters_(parameters),
      objects_(parameters_),
      ip_(parameters_),
      plant_(parameters.plant, parameters.initial_position) {}

EposCounters EposDrive::Implementation::counters() const {
  EposCounters counters = counters_;
  counters.emergencies = emergencies();
  counters.lost_frames = lost_frames();
  counters.underflows = ip_.underflows();
  counters.overflows = ip_.overflows();
  counters.minimum_fill = ip_.minimum_fill();
  return counters;
}

void EposDrive::Implementation::booted() {
  device_.reset();
  ip_.reset();
  start_requested_ = ip_bit_ = halt_ = halted_ = connection_error_ = false;
  window_ms_ = 0;
  plant_.stand();
  demand_ = {plant_.position(), 0.0, 0.0};
  objects_.set(kObject<0x6061, 0>, objects_.get(kObject<0x6060, 0>));
  update_limits();
  publish_motion();
}

void EposDrive::Implementation::powered_off() {
  if (!parameters_.position_survives_power_off) plant_.place(0.0);
  plant_.stand();
}

void EposDrive::Implementation::connection_lost() {
  connection_error_ = true;
  const OptionCodes options = option_codes(objects_);
  if (options.abort_connection >= 1 && options.abort_connection <= 3) stop_interpolation();
  device_.connection_lost(options);
}

void EposDrive::Implementation::heartbeat_heard() {
  const bool faulty = device_.state() == DeviceState::Fault || device_.state() == DeviceState::FaultReaction;
  if (!connection_error_ || faulty) return;
  connection_error_ = false;
  reset_errors();
}

// A message is sent once for an error (CiA 301, 7.2.7): what goes on while the drive is in fault for it is
// none.
void EposDrive::Implementation::fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  const bool faulty = device_.state() == DeviceState::Fault || device_.state() == DeviceState::FaultReaction;
  if (!on() || (faulty && code == fault_code_)) return;
  fault_code_ = code;
  emergency(code, error_register, now);
  stop_interpolation();
  device_.fault(option_codes(objects_));
  publish_status();
}

void EposDrive::Implementation::controlword(std::uint16_t word) {
  const bool was_enabled = ip_bit_;
  ip_bit_ = (word & kEnableIpMode) != 0;
  halt_ = (word & kHalt) != 0;
  if (device_.command(word, option_codes(objects_))) {
    connection_error_ = false;
    ip_.on_fault_reset();
    reset_errors();
  }
  if (!device_.in_control()) return stop_interpolation();
  if (mode() == kInterpolatedPositionMode) command_interpolation(ip_bit_, was_enabled);
}

void EposDrive::Implementation::command_interpolation(bool enabled, bool was_enabled) {
  if (enabled && !was_enabled) start_requested_ = true;
  if (!enabled) stop_interpolation();
}

void EposDrive::Implementation::stop_interpolation() {
  const bool was_active = ip_.active();
  start_requested_ = false;
  halted_ = false;
  ip_.stop();
  if (was_active && device_.in_control() && parameters_.active_stop == ActiveStop::AtOnce) stop_at_once();
}

void EposDrive::Implementation::select_mode(int selected) {
  const int before = mode();
  objects_.set(kObject<0x6061, 0>, selected);
  if (selected == before) return;
  if (before == kInterpolatedPositionMode) stop_interpolation();
  if (selected == kInterpolatedPositionMode) ip_.select();
}

int EposDrive::Implementation::mode() const { return static_cast<int>(objects_.get(kObject<0x6061, 0>)); }

std::uint16_t EposDrive::Implementation::statusword() const {
  unsigned word = device_.status_bits();
  if (operational()) word |= kRemote;
  if (parameters_.homed) word |= kHomed;
  if (!device_.operation_enabled()) return static_cast<std::uint16_t>(word);
  if (ip_.active()) word |= kIpActive;
  const bool at_rest = demand_.velocity == 0.0;
  const bool windowed = objects_.get(kObject<0x6067, 0>) != kNoWindow;
  const bool in_window = !windowed || window_ms_ > objects_.get(kObject<0x6068, 0>);
  const bool idle = !ip_.active() && !start_requested_;
  if (at_rest && (halt_ || (idle && in_window))) word |= kTargetReached;
  return static_cast<std::uint16_t>(word);
}

void EposDrive::Implementation::publish_status() {
  objects_.set(kObject<0x6041, 0>, statusword());
  objects_.set(kObject<0x20C4, 1>, ip_.status());
  objects_.set(kObject<0x60C4, 2>, PvtBuffer::kCapacity - ip_.fill());
  objects_.set(kObject<0x60C4, 4>, ip_.fill());
}

}  // namespace interpolated_motion::emulation
