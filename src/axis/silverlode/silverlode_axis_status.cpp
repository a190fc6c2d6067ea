#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

// What is published of the axis.

std::string SilverlodeAxis::description() const {
  return fmt::format("{}: SilverLode drive, revision {}, {}", who(), revision_, delivery_->description());
}

double SilverlodeAxis::rest_position() const {
  return parameters_.transmission.joint_position(enabled() ? rest_counts_ : status_.actual_counts());
}

void SilverlodeAxis::status(HostTime now, AxisStatus& out) const {
  const double elapsed = clock_.elapsed(now);
  const bool playing = is_motion_phase() && feed_.loaded();
  out.online = stage() != Stage::Offline && stage() != Stage::Probing;
  out.state = state_text();
  out.statusword = status_.polling.raw;
  out.mode = 0;
  out.demand_position = demand_at(now);
  out.following_error = demand_at(feedback().time) - feedback().position;
  out.error_code = status_.polling.fault() ? status_.polling.raw : std::uint16_t{0};
  out.error_text = status_.polling.fault() ? status_.polling.text() : std::string();
  out.capacity = static_cast<std::uint32_t>(delivery_->capacity());
  out.fill = feed_.loaded() && (playing || phase() == Phase::Loaded)
                 ? static_cast<std::uint32_t>(feed_.waiting(elapsed, clock_.running()))
                 : 0;
  out.fill_time = playing ? std::max(0.0, feed_.queue_end() - elapsed) : 0.0;
  out.underflow_warning = playing && !feed_.all_sent() && out.fill == 0;
  out.overflow_warning = false;
  out.velocity_warning = false;
  out.acceleration_warning = false;
  out.underruns = underruns_;
  out.overflows = 0;
  out.refused_writes = delivery_->refused_writes();
  out.records_sent = delivery_->records_sent();
  out.clock_error_ppm = clock_error_ppm_;
}

/// Where the drive's demand is at `when`, rad.
double SilverlodeAxis::demand_at(HostTime when) const {
  return is_motion_phase() ? feed_.path().sample(playback_of_feed(when)).position : rest_position();
}

std::string SilverlodeAxis::state_text() const {
  if (stage() == Stage::FaultStopping) return "Stopping with a fault";
  if (stage() == Stage::Fault || status_.polling.fault()) return "Fault";
  if (stage() == Stage::Offline || stage() == Stage::Probing) return "Offline";
  if (is_motion_phase()) return "Interpolated motion";
  return enabled() ? "Driver enabled" : "Driver disabled";
}

AxisReport SilverlodeAxis::report() const {
  return {feed_.sent(), minimum_fill_, underruns_ - underruns_at_load_,
          delivery_->refused_writes() - refused_at_load_};
}

}  // namespace interpolated_motion::axis
