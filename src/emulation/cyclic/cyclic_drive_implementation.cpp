#include "cyclic_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kNoMode = 0;
constexpr std::int64_t kCyclicSynchronousPosition = 8;

// Statusword bits of CiA 402; 12 and 13 as in the cyclic synchronous position mode.
constexpr unsigned kRemote = 1U << 9;
constexpr unsigned kFollowsCommand = 1U << 12;
constexpr unsigned kFollowingError = 1U << 13;

const CyclicParameters& validated(const CyclicParameters& parameters) {
  validate(parameters);
  return parameters;
}

NodeSettings node_settings(const CyclicParameters& parameters) {
  NodeSettings settings;
  settings.node_id = parameters.node_id;
  settings.device_name = parameters.device_name;
  settings.clock.error_ppm = parameters.clock_error_ppm;
  settings.clock.sample_period = parameters.servo_period;
  settings.sample_phase = parameters.tick_phase;
  settings.boot_time = parameters.boot_time;
  settings.sdo_response_time = parameters.sdo_response_time;
  settings.pdo_setup_only_pre_operational = parameters.pdo_setup_only_pre_operational;
  return settings;
}

double in_ms(HostDuration d) { return seconds(d) * 1e3; }

// The plant counts time in its own steps, here servo samples.
PlantParameters in_samples(PlantParameters plant, double servo_ms) {
  plant.lag_ms /= servo_ms;
  return plant;
}

}  // namespace

CyclicDrive::Implementation::Implementation(transport::VirtualCanBus& bus, transport::CanListener& listener,
                                            const CyclicParameters& parameters, HostTime now)
    : CanopenServo(bus, listener, node_settings(validated(parameters)), objects_, now),
      parameters_(parameters),
      servo_ms_(in_ms(parameters.servo_period)),
      objects_(parameters_),
      plant_(in_samples(parameters.plant, servo_ms_), parameters.initial_position) {}

std::int64_t CyclicDrive::Implementation::object(std::uint16_t index, std::uint8_t subindex) const {
  return objects_.get(kCyclicTable.slot(index, subindex));
}

void CyclicDrive::Implementation::booted() {
  device_.reset();
  error_code_ = 0;
  plant_.stand();
  demand_ = {plant_.position(), 0.0, 0.0};
  configure_interpolation();
  enter_mode();
  publish_motion();
}

void CyclicDrive::Implementation::powered_off() { plant_.stand(); }

void CyclicDrive::Implementation::connection_lost() { device_.connection_lost(option_codes(objects_)); }

void CyclicDrive::Implementation::fault(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  if (!on()) return;
  emergency(code, error_register, now);
  error_code_ = code;
  device_.fault(option_codes(objects_));
  publish_status();
}

AbortCode CyclicDrive::Implementation::check_value(const ObjectEntry& entry, std::int64_t value) const {
  const bool mode = entry.index == 0x6060;
  return mode && value != kNoMode && value != kCyclicSynchronousPosition ? AbortCode::ValueRange
                                                                         : AbortCode::None;
}

void CyclicDrive::Implementation::written(const ObjectEntry& entry, std::int64_t value) {
  switch (entry.index) {
    case 0x6040:
      return controlword(static_cast<std::uint16_t>(value));
    case 0x6060:
      if (object(0x6061, 0) == value) return;
      objects_.set(kCyclicObject<0x6061, 0>, value);
      return enter_mode();
    case 0x607A:
      return target_position(static_cast<std::int32_t>(value));
    case 0x60B1:
    case 0x60B2:
      if (own_ms() == updated_ms_) feed_forward();
      return;
    case 0x2100:
    case 0x60C2:
      return configure_interpolation();
    default:
      return;
  }
}

void CyclicDrive::Implementation::controlword(std::uint16_t word) {
  const bool was_in_control = device_.in_control();
  if (device_.command(word, option_codes(objects_))) {
    error_code_ = 0;
    reset_errors();
  }
  if (device_.in_control() && !was_in_control) enter_mode();
}

void CyclicDrive::Implementation::enter_mode() {
  interpolation_.enter(demand_.position);
  following_error_ms_ = 0.0;
  feeds_forward_ = false;
}

void CyclicDrive::Implementation::configure_interpolation() {
  interpolation_.set_grid(static_cast<double>(object(0x60C2, 1)), parameters_.sync_gain);
  interpolation_.set_order(static_cast<int>(object(0x2100, 1)));
}

void CyclicDrive::Implementation::target_position(std::int32_t position) {
  if (!device_.in_control() || object(0x6061, 0) != kCyclicSynchronousPosition) return;
  // Where the axis stands by now: it may have been braking when the mode was entered.
  if (!interpolation_.following()) interpolation_.enter(demand_.position);
  interpolation_.update(position, own_ms());
  updated_ms_ = own_ms();
  feed_forward();
  ++updates_;
}

// Whichever comes first at a SYNC, offset or target position: they belong together.
void CyclicDrive::Implementation::feed_forward() {
  const double velocity = static_cast<double>(object(0x60B1, 0)) * parameters_.velocity_unit;
  const auto torque = static_cast<double>(object(0x60B2, 0));
  feeds_forward_ = feeds_forward_ || velocity != 0.0;
  interpolation_.feed_forward(velocity * 1e-3, torque);
}

std::uint16_t CyclicDrive::Implementation::statusword() const {
  unsigned word = device_.status_bits();
  if (operational()) word |= kRemote;
  if (device_.in_control() && interpolation_.following()) word |= kFollowsCommand;
  if (following_error_) word |= kFollowingError;
  return static_cast<std::uint16_t>(word);
}

void CyclicDrive::Implementation::publish_status() {
  objects_.set(kCyclicObject<0x6041, 0>, statusword());
  objects_.set(kCyclicObject<0x603F, 0>, error_code_);
}

}  // namespace interpolated_motion::emulation
