#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

#include <fmt/format.h>

#include <stdexcept>

#include "interpolated_motion_driver/emulation/silverdust/profile.h"

namespace interpolated_motion::emulation {
namespace {

template <class Value>
void require(bool valid, const SilverDustParameters& parameters, const char* name, const Value& value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(fmt::format("emulated drive with address {}: {} is {}, allowed is {}",
                                          parameters.address, name, value, range));
}

template <class Value>
void require_range(const SilverDustParameters& p, const char* name, Value value, Value low, Value high) {
  require(value >= low && value <= high, p, name, value, fmt::format("{}..{}", low, high).c_str());
}

void require_duration(const SilverDustParameters& p, const char* name, HostDuration value) {
  require(value >= HostDuration::zero(), p, name, value.count(), "0 ns or more");
}

}  // namespace

void validate(const SilverDustParameters& p) {
  require_range(p, "address", p.address, 1, 254);
  require_range(p, "group", p.group, 0, 254);
  require_range(p, "queue_depth", p.queue_depth, 1, 64);
  require_range(p, "counts_per_revolution", p.counts_per_revolution, 1, 1'000'000);
  require_range(p, "velocity_full_scale_rpm", p.velocity_full_scale_rpm, 1, 100'000);
  require_range(p, "ims_acceleration_full_scale", p.ims_acceleration_full_scale, 1, 100'000);
  require_range(p, "acceleration_full_scale", p.acceleration_full_scale, 1, 100'000);
  require_range<std::int64_t>(p, "tick", p.tick.count(), 10'000, 1'000'000);
  require_range(p, "clock_error_ppm", p.clock_error_ppm, -100'000.0, 100'000.0);
  require(p.tick_phase >= HostDuration::zero() && p.tick_phase < p.tick, p, "tick_phase",
          p.tick_phase.count(), "0 ns to less than a tick");
  require(p.ims_arguments == -1 || p.ims_arguments == 0 || p.ims_arguments == 2, p, "ims_arguments",
          p.ims_arguments, "-1 (both), 0 or 2");
  require_range(p, "ack_delay", p.ack_delay, 0, 65'535);
  require_duration(p, "turnaround", p.turnaround);
  require_duration(p, "boot_time", p.boot_time);
  require_range(p, "moving_error_limit", p.moving_error_limit, 1, 32'767);
  require_range(p, "holding_error_limit", p.holding_error_limit, 1, 32'767);
  require_range(p, "holding_delay", p.holding_delay, 0, 65'535);
  require(p.plant.lag_ticks >= 0.0, p, "plant.lag_ticks", p.plant.lag_ticks, "0 or more");
  ProfileScale{p};
}

}  // namespace interpolated_motion::emulation
