#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/cyclic/bring_up.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/cyclic_objects.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;

namespace {

/// Longest that drives are known to ride out missing target positions, periods.
constexpr int kRideThrough = 10;

void require(bool valid, const CyclicAxisParameters& parameters, const char* name, double value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(
      fmt::format("drives/{}/{} is {}, allowed is {}", parameters.joint, name, value, range));
}

CyclicAxisParameters checked(CyclicAxisParameters p) {
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

CyclicAxis::CyclicAxis(CyclicAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node)
    : Cia402Axis({parameters.joint, cia402::Mode::CyclicSynchronousPosition, cyclic_pdo::kControlwordRpdo,
                  parameters.heartbeat_timeout, parameters.bring_up_timeout},
                 master, node),
      parameters_(checked(std::move(parameters))),
      setpoints_(parameters_.transmission, parameters_.sync_period, parameters_.interpolation_order) {
  const auto& bus = master.parameters();
  require(bus.isochronous && bus.sync_period == parameters_.sync_period, parameters_, "sync_period",
          seconds(parameters_.sync_period), "that of an isochronous bus");
  node.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

void CyclicAxis::poll(HostTime now) {
  Cia402Axis::poll(now);
  send_target();
}

AxisState CyclicAxis::enabled_state() const {
  switch (phase_) {
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Loading:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Moving:
      return AxisState::Moving;
    case Phase::Braking:
      return AxisState::Stopping;
    case Phase::Off:
    case Phase::Following:
      break;
  }
  return AxisState::Enabling;
}

void CyclicAxis::poll_enabled(HostTime now) {
  switch (phase_) {
    case Phase::Following:
      return poll_following(now);
    case Phase::Loading:
      return enter_phase(Phase::Loaded, now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Braking:
      return poll_braking(now);
    case Phase::Off:
    case Phase::Ready:
    case Phase::Loaded:
      return;
  }
}

void CyclicAxis::enter_phase(Phase phase, HostTime now) {
  phase_ = phase;
  begin_phase(now);
}

// ---- bring-up and enabling

std::vector<SdoSequence::Step> CyclicAxis::bring_up_steps() {
  identity_ = {};
  return cyclic_bring_up_steps(parameters_, node().id(), identity_);
}

void CyclicAxis::on_started() { setpoints_.rest(telemetry_.position); }

void CyclicAxis::on_mode_selected() { setpoints_.restart(); }

// Until the power stage goes on, the target is where the axis is; then it stays there.
void CyclicAxis::on_enabling() {
  const bool told_to_enable =
      controlword().sent_at() >= since() && controlword().word() == cia402::controlword::kEnableOperation;
  if (!told_to_enable) rest_counts_ = telemetry_.position;
  setpoints_.rest(rest_counts_);
}

void CyclicAxis::on_enabled(HostTime now) {
  enter_phase(Phase::Following, now);
  poll_following(now);
}

void CyclicAxis::poll_following(HostTime now) {
  if (telemetry_.statusword.follows_command()) return enter_phase(Phase::Ready, now);
  if (expired(now, kStateTimeout)) {
    fail(fmt::format("the drive is enabled but does not follow its target position (bit 12); statusword: {}",
                     telemetry_.statusword.text()),
         now);
  }
}

// ---- what the drive tells

void CyclicAxis::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  if (!telemetry_.take(number, frame, time, master().last_sync_time())) return;
  note_report();
  const auto& transmission = parameters_.transmission;
  feedback_.time = telemetry_.position_time;
  feedback_.position = transmission.joint_position(telemetry_.position);
  feedback_.velocity = transmission.joint_velocity(telemetry_.velocity * parameters_.velocity_unit);
}

std::string CyclicAxis::text_of(const canopen::Emcy& emcy) const {
  const bool sync = emcy.code == cia402::emergency_code::kSyncController;
  return fmt::format("EMCY 0x{:04X}{} (error register 0x{:02X}: {})", emcy.code,
                     sync ? " sync controller, target positions have failed to come" : "",
                     emcy.error_register, cia402::error_register_text(emcy.error_register));
}

// ---- results

std::string CyclicAxis::description() const {
  return fmt::format("{}: {}, serial number {}, a target position each {:.0f} ms", who(),
                     cia402::describe_identity(identity_), identity_.serial,
                     seconds(parameters_.sync_period) * 1e3);
}

/// A drive that is still enabled is told to brake by its quick stop.
void CyclicAxis::give_up(HostTime now) {
  Cia402Axis::give_up(now);
  press_stop(now);
}

void CyclicAxis::press_stop(HostTime now) {
  using cia402::controlword::kQuickStop;
  if (!obeys() || (controlword().word() == kQuickStop && !controlword().overdue(now))) return;
  controlword().send(kQuickStop, now);
}

/// Without target positions the drive goes on along its polynomial for a few periods, then brakes.
HostDuration CyclicAxis::longest_motion(HostTime) const {
  const double ramp = parameters_.limits.max_velocity / parameters_.limits.max_acceleration;
  return kRideThrough * parameters_.sync_period + host_duration(ramp);
}

double CyclicAxis::rest_position() const {
  return parameters_.transmission.joint_position(enabled() ? rest_counts_ : telemetry_.position);
}

void CyclicAxis::status(HostTime now, AxisStatus& out) const {
  const auto& transmission = parameters_.transmission;
  const HostDuration ahead = setpoints_.newest() - now;
  const bool streams = wants_targets() && ahead > 0ns;
  fill_status(out);
  out.demand_position = transmission.joint_position(telemetry_.position_demand);
  out.following_error = telemetry_.following_error / transmission.counts_per_radian();
  out.capacity = 1;
  out.fill = streams ? 1 : 0;
  out.fill_time = streams ? seconds(ahead) : 0.0;
  out.underflow_warning = out.overflow_warning = false;
  out.velocity_warning = out.acceleration_warning = false;
  out.underruns = static_cast<std::uint32_t>(setpoints_.missed());
  out.overflows = 0;
  out.refused_writes = static_cast<std::uint32_t>(refused_);
  out.records_sent = sent_;
  out.clock_error_ppm = 0.0;
}

AxisReport CyclicAxis::report() const {
  const auto missed = static_cast<std::uint32_t>(setpoints_.missed() - missed_at_load_);
  return {sent_ - sent_at_load_, missed == 0 ? 1U : 0U, missed};
}

}  // namespace interpolated_motion::axis
