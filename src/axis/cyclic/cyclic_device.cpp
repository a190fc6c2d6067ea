#include "interpolated_motion_driver/axis/cyclic/cyclic_device.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cia402/pdo_check.h"
#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/axis/cyclic/bring_up.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;

namespace {

void require(bool valid, const CyclicAxisParameters& parameters, const char* name, double value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(
      fmt::format("drives/{}/{} is {}, allowed is {}", parameters.joint, name, value, range));
}

const CyclicAxisParameters& checked(const CyclicAxisParameters& p) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool whole = p.sync_period % 1ms == 0ns && p.sync_period >= 1ms && p.sync_period <= 20ms;
  require(positive(p.limits.max_velocity), p, "limits/max_velocity", p.limits.max_velocity,
          "a finite number above 0");
  require(positive(p.limits.max_acceleration), p, "limits/max_acceleration", p.limits.max_acceleration,
          "a finite number above 0, since stops are made with it");
  require(whole, p, "sync_period", seconds(p.sync_period), "a whole number of ms, 0.001..0.02 s (0x60C2)");
  require(p.interpolation_order >= 1 && p.interpolation_order <= 3, p, "interpolation_order",
          p.interpolation_order, "1..3");
  require(positive(p.servo_period) && p.servo_period <= seconds(p.sync_period), p, "servo_period",
          p.servo_period, "above 0 to sync_period");
  require(positive(p.velocity_unit), p, "velocity_unit", p.velocity_unit, "a finite number above 0");
  require(positive(p.acceleration_unit), p, "acceleration_unit", p.acceleration_unit,
          "a finite number above 0");
  return p;
}

}  // namespace

encoding::SetpointEncoding setpoint_encoding(const CyclicAxisParameters& parameters) {
  encoding::SetpointEncoding encoding;
  encoding.joint = parameters.joint;
  encoding.transmission = parameters.transmission;
  encoding.period = GoalTime{seconds(parameters.sync_period)};
  encoding.order = parameters.interpolation_order;
  encoding.servo_period = GoalTime{parameters.servo_period};
  encoding.bound_counts = parameters.deviation_bound;
  encoding.max_acceleration = parameters.limit_margin * parameters.limits.max_acceleration;
  return encoding;
}

CyclicDevice::CyclicDevice(const CyclicAxisParameters& parameters, canopen::Master& master,
                           canopen::NodeLink& node)
    : parameters_(checked(parameters)),
      master_(master),
      node_(node),
      setpoints_(setpoint_encoding(parameters_), parameters_.limits) {
  const auto& bus = master.parameters();
  require(bus.isochronous && bus.sync_period == parameters_.sync_period, parameters_, "sync_period",
          seconds(parameters_.sync_period), "that of an isochronous bus");
  node.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

std::string CyclicDevice::description() const {
  return fmt::format("{}, serial number {}, a target position each {:.0f} ms",
                     cia402::describe_identity(identity_), identity_.serial,
                     seconds(parameters_.sync_period) * 1e3);
}

std::vector<SdoSequence::Step> CyclicDevice::enable_steps() const {
  auto steps = pdo_check({cyclic_pdo::target_rpdo(facts_.takes_velocity), cyclic_pdo::controlword_rpdo(),
                          cyclic_pdo::status_tpdo(), cyclic_pdo::velocity_tpdo(parameters_.sync_period)},
                         node_.id());
  sdo_steps::append(steps, cyclic_position_limit_steps(parameters_, feedback_.position));
  return steps;
}

std::vector<SdoSequence::Step> CyclicDevice::bring_up_steps(SdoSequence& sequence) {
  identity_ = {};
  return cyclic_bring_up_steps(parameters_, node_.id(), identity_, sequence, facts_);
}

// Until the power stage goes on, the target is where the axis is; then it stays there.
void CyclicDevice::on_enabling(bool commanded) {
  if (!commanded) enabled_at_ = telemetry_.position;
  setpoints_.rest(enabled_at_);
}

std::uint16_t CyclicDevice::stop_word() const { return cia402::controlword::kQuickStop; }

void CyclicDevice::take_position(std::int32_t position, HostTime now) {
  telemetry_.position = position;
  telemetry_.position_time = now;
  feedback_ = {now, parameters_.transmission.joint_position(position), 0.0};
}

void CyclicDevice::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  if (!telemetry_.take(number, frame, time, master_.last_sync_time())) return;
  const auto& transmission = parameters_.transmission;
  feedback_.time = telemetry_.position_time;
  feedback_.position = transmission.joint_position(telemetry_.position);
  feedback_.velocity = transmission.joint_velocity(telemetry_.velocity * parameters_.velocity_unit);
}

std::string CyclicDevice::text_of(const canopen::Emcy& emcy) const {
  const bool sync = emcy.code == cia402::emergency_code::kSyncController;
  return fmt::format("EMCY 0x{:04X}{} (error register 0x{:02X}: {})", emcy.code,
                     sync ? " sync controller, target positions have failed to come" : "",
                     emcy.error_register, cia402::error_register_text(emcy.error_register));
}

}  // namespace interpolated_motion::axis
