#include "interpolated_motion_driver/axis/epos/epos_device.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cia402/pdo_check.h"
#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/axis/epos/host_watch.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"

namespace interpolated_motion::axis {

namespace cw = cia402::controlword;

namespace {

void require_finite(const EposAxisParameters& parameters, double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw std::invalid_argument(
      fmt::format("drives/{}/limits/{} is {}: an EPOS drive needs a finite limit above 0, since it checks "
                  "every motion against it. Set "
                  "it in the URDF or in the configuration.",
                  parameters.joint, name, value));
}

}  // namespace

EposDevice::EposDevice(EposAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node)
    : parameters_(std::move(parameters)), master_(master), node_(node) {
  require_finite(parameters_, parameters_.limits.max_velocity, "max_velocity");
  require_finite(parameters_, parameters_.limits.max_acceleration, "max_acceleration");
  node.set_sync_answer(epos_pdo::kMotionTpdo);
  node.set_sync_answer(epos_pdo::kBufferTpdo);
  node.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

std::string EposDevice::description() const {
  return fmt::format("{}, serial number {}, velocity unit {} rpm, FIFO of {} records, {}",
                     cia402::describe_identity(facts_.identity), facts_.identity.serial,
                     facts_.velocity_unit_rpm(), facts_.capacity, clock_text());
}

std::string EposDevice::clock_text() const {
  if (facts_.takes_time_stamps) return "clock set by the host's (0x1013)";
  if (!parameters_.clock_discipline) return "clock on its own (clock_discipline is false)";
  return "clock on its own, it takes no time stamps: " + facts_.time_stamp_refusal;
}

std::vector<SdoSequence::Step> EposDevice::bring_up_steps(SdoSequence& sequence) {
  facts_ = EposFacts{};
  return epos_bring_up_steps(parameters_, node_.id(), sequence, facts_);
}

std::vector<SdoSequence::Step> EposDevice::enable_steps() const {
  auto steps = pdo_check({epos_pdo::record_rpdo(), epos_pdo::controlword_rpdo(), epos_pdo::status_tpdo(),
                          epos_pdo::motion_tpdo(), epos_pdo::buffer_tpdo(facts_.free_records_mapped)},
                         node_.id());
  sdo_steps::append(steps, epos_position_limit_steps(parameters_, feedback_.position));
  steps.push_back(watch_host_at_rest(parameters_));
  return steps;
}

// A fault in motion has left the drive with the watch of a motion.
std::vector<SdoSequence::Step> EposDevice::reset_steps() const { return {watch_host_at_rest(parameters_)}; }

bool EposDevice::has_reported(HostTime since) const {
  return telemetry_.status_time > since && telemetry_.motion_time > since;
}

/// Halted it stays in its mode and at its position until the reset.
std::uint16_t EposDevice::stop_word() const { return cw::kStartInterpolation | cw::kHaltBit; }

void EposDevice::take_position(std::int32_t position, HostTime now) {
  telemetry_.position = position;
  telemetry_.motion_time = now;
  feedback_ = {now, parameters_.transmission.joint_position(position), 0.0};
}

void EposDevice::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  const cia402::BufferStatus before = telemetry_.buffer_status;
  if (!telemetry_.take(number, frame, time, master_.last_sync_time())) return;
  note_buffer_errors(before);
  if (number != epos_pdo::kMotionTpdo) return;
  feedback_.time = telemetry_.motion_time;
  feedback_.position = parameters_.transmission.joint_position(telemetry_.position);
  feedback_.velocity = parameters_.transmission.joint_velocity(counts_per_second(telemetry_.velocity));
}

void EposDevice::note_buffer_errors(cia402::BufferStatus before) {
  const cia402::BufferStatus& after = telemetry_.buffer_status;
  if (after.underflow_error() && !before.underflow_error()) ++underruns_;
  if (after.overflow_error() && !before.overflow_error()) ++overflows_;
}

double EposDevice::counts_per_second(std::int32_t velocity) const {
  return velocity * facts_.velocity_unit_rpm() / 60.0 * parameters_.transmission.counts_per_revolution;
}

std::string EposDevice::text_of(const canopen::Emcy& emcy) const { return cia402::emergency_text(emcy); }

std::string EposDevice::fault_detail() const {
  return telemetry_.buffer_status.any_error() ? ", FIFO: " + telemetry_.buffer_status.text() : std::string();
}

}  // namespace interpolated_motion::axis
