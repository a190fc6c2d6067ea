#include "interpolated_motion_driver/axis/epos/epos_axis.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/emergency.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;
using canopen::SdoResult;

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

EposAxis::EposAxis(EposAxisParameters parameters, canopen::Master& master, canopen::NodeLink& node)
    : Cia402Axis({parameters.joint, cia402::Mode::InterpolatedPosition, epos_pdo::kControlwordRpdo,
                  parameters.heartbeat_timeout, parameters.bring_up_timeout},
                 master, node),
      parameters_(std::move(parameters)) {
  require_finite(parameters_, parameters_.limits.max_velocity, "max_velocity");
  require_finite(parameters_, parameters_.limits.max_acceleration, "max_acceleration");
  node.set_sync_answer(epos_pdo::kMotionTpdo);
  node.set_sync_answer(epos_pdo::kBufferTpdo);
  node.set_tpdo_handler(
      [this](int number, const canopen::Frame& frame, HostTime time) { on_tpdo(number, frame, time); });
}

AxisState EposAxis::enabled_state() const {
  switch (phase_) {
    case Phase::Ready:
      return AxisState::Ready;
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Verifying:
      return AxisState::Loading;
    case Phase::Loaded:
      return AxisState::Loaded;
    case Phase::Armed:
    case Phase::Moving:
    case Phase::Ending:
      return AxisState::Moving;
    case Phase::Braking:
    case Phase::Emptying:
      return AxisState::Stopping;
    case Phase::Off:
    case Phase::ReadingRest:
      break;
  }
  return AxisState::Enabling;
}

void EposAxis::poll_enabled(HostTime now) {
  switch (phase_) {
    case Phase::ReadingRest:
      return poll_reading_rest(now);
    case Phase::Clearing:
      return poll_clearing(now);
    case Phase::Filling:
      return poll_filling(now);
    case Phase::Verifying:
      return poll_verifying(now);
    case Phase::Armed:
      return poll_armed(now);
    case Phase::Moving:
      return poll_moving(now);
    case Phase::Ending:
      return poll_ending(now);
    case Phase::Braking:
      return poll_braking(now);
    case Phase::Emptying:
      return poll_emptying(now);
    case Phase::Off:
    case Phase::Ready:
    case Phase::Loaded:
      return;
  }
}

void EposAxis::enter_phase(Phase phase, HostTime now) {
  phase_ = phase;
  begin_phase(now);
}

// ---- bring-up and enabling

std::vector<SdoSequence::Step> EposAxis::bring_up_steps() {
  early_release_.reset();
  facts_ = EposFacts{};
  return epos_bring_up_steps(parameters_, node().id(), sequence(), facts_);
}

bool EposAxis::has_reported(HostTime since) const {
  return telemetry_.status_time > since && telemetry_.motion_time > since;
}

void EposAxis::on_enabled(HostTime now) { read_rest({}, Phase::ReadingRest, now); }

void EposAxis::poll_reading_rest(HostTime now) {
  if (sequence_done(now)) enter_phase(Phase::Ready, now);
}

/// Does `before`, then reads where the demand rests, in `phase`.
void EposAxis::read_rest(std::vector<SdoSequence::Step> before, Phase phase, HostTime now) {
  before.push_back(
      SdoSequence::read(object::kPositionDemand, [this](const SdoResult& r) -> std::optional<std::string> {
        if (!r.ok) return r.text();
        rest_counts_ = r.as_i32();
        return std::nullopt;
      }));
  enter_phase(phase, now);
  sequence().start(std::move(before), now);
}

// ---- what the drive tells
// ------------------------------------------------------------------------------------------

void EposAxis::on_tpdo(int number, const canopen::Frame& frame, HostTime time) {
  const cia402::BufferStatus before = telemetry_.buffer_status;
  if (!telemetry_.take(number, frame, time, master().last_sync_time())) return;
  note_buffer_errors(before);
  if (number != epos_pdo::kMotionTpdo) return;
  note_report();
  feedback_.time = telemetry_.motion_time;
  feedback_.position = parameters_.transmission.joint_position(telemetry_.position);
  feedback_.velocity = parameters_.transmission.joint_velocity(counts_per_second(telemetry_.velocity));
}

double EposAxis::counts_per_second(std::int32_t velocity) const {
  return velocity * facts_.velocity_unit_rpm() / 60.0 * parameters_.transmission.counts_per_revolution;
}

void EposAxis::note_buffer_errors(cia402::BufferStatus before) {
  const cia402::BufferStatus& after = telemetry_.buffer_status;
  if (after.underflow_error() && !before.underflow_error()) ++underruns_;
  if (after.overflow_error() && !before.overflow_error()) ++overflows_;
}

std::string EposAxis::text_of(const canopen::Emcy& emcy) const { return cia402::emergency_text(emcy); }

std::string EposAxis::fault_detail() const {
  return telemetry_.buffer_status.any_error() ? ", FIFO: " + telemetry_.buffer_status.text() : std::string();
}

// ---- results
// -------------------------------------------------------------------------------------------------------

std::string EposAxis::description() const {
  return fmt::format("{}: {}, serial number {}, velocity unit {} rpm, FIFO of {} records, {}", who(),
                     cia402::describe_identity(facts_.identity), facts_.identity.serial,
                     facts_.velocity_unit_rpm(), facts_.capacity, clock_text());
}

std::string EposAxis::clock_text() const {
  if (facts_.takes_time_stamps) return "clock set by the host's (0x1013)";
  if (!parameters_.clock_discipline) return "clock on its own (clock_discipline is false)";
  return "clock on its own, it takes no time stamps: " + facts_.time_stamp_refusal;
}

void EposAxis::give_up(HostTime now) {
  Cia402Axis::give_up(now);
  node().clear_records();
}

double EposAxis::rest_position() const {
  return parameters_.transmission.joint_position(enabled() ? rest_counts_ : telemetry_.position);
}

void EposAxis::status(HostTime now, AxisStatus& out) const {
  const auto& transmission = parameters_.transmission;
  const double elapsed = clock_.elapsed(now);
  const bool loading = phase() == Phase::Filling || phase() == Phase::Verifying || phase() == Phase::Loaded;
  fill_status(out);
  out.demand_position = transmission.joint_position(telemetry_.position_demand);
  out.following_error = telemetry_.following_error / transmission.counts_per_radian();
  out.capacity = facts_.capacity;
  out.fill = loading || is_playing() ? static_cast<std::uint32_t>(feed_.sent() - feed_.played(elapsed)) : 0;
  out.fill_time = loading || is_playing() ? feed_.time_ahead(elapsed) : 0.0;
  out.underflow_warning = telemetry_.buffer_status.underflow_warning();
  out.overflow_warning = telemetry_.buffer_status.overflow_warning();
  out.velocity_warning = telemetry_.buffer_status.velocity_warning();
  out.acceleration_warning = telemetry_.buffer_status.acceleration_warning();
  out.underruns = underruns_;
  out.overflows = overflows_;
  out.refused_writes = refused_writes_;
  out.records_sent = records_sent_;
  out.clock_error_ppm = clock_.error_ppm();
}

AxisReport EposAxis::report() const {
  return {feed_.sent(), minimum_fill_, underruns_ - underruns_at_load_, refused_writes_ - refused_at_load_};
}

}  // namespace interpolated_motion::axis
