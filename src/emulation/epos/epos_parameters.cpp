#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"

#include <fmt/format.h>

#include <stdexcept>

#include "interpolated_motion_driver/emulation/limits.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::size_t kLongestName = 32;
constexpr HostDuration kSample = std::chrono::milliseconds(1);

template <class Value>
void require(bool valid, const EposParameters& parameters, const char* name, const Value& value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(fmt::format("emulated drive with node id {}: {} is {}, allowed is {}",
                                          parameters.node_id, name, value, range));
}

}  // namespace

void validate(const EposParameters& p) {
  require(p.node_id >= 1 && p.node_id <= 127, p, "node_id", p.node_id, "1..127");
  require(p.device_name.size() >= 1 && p.device_name.size() <= kLongestName, p, "device_name", p.device_name,
          "1..32 characters");
  require(p.clock_error_ppm >= -kLargestClockError && p.clock_error_ppm <= kLargestClockError, p,
          "clock_error_ppm", p.clock_error_ppm, "-100000..100000");
  require(p.clock_slew > HostDuration::zero() && p.clock_slew <= kSample / 2, p, "clock_slew",
          p.clock_slew.count(), "1..500000 ns");
  require(p.tick_phase >= HostDuration::zero() && p.tick_phase < kSample, p, "tick_phase",
          p.tick_phase.count(), "0..999999 ns");
  require(p.boot_time >= kSample, p, "boot_time", p.boot_time.count(), "1000000 ns or more");
  require(p.sdo_response_time >= HostDuration::zero(), p, "sdo_response_time", p.sdo_response_time.count(),
          "0 ns or more");
  require(p.counts_per_revolution > 0, p, "counts_per_revolution", p.counts_per_revolution, "1 or more");
  require(p.plant.lag_ms >= 0.0, p, "plant.lag_ms", p.plant.lag_ms, "0 or more");
  require(p.lowest_velocity_notation <= 0 && p.lowest_velocity_notation >= -6, p, "lowest_velocity_notation",
          static_cast<int>(p.lowest_velocity_notation), "-6..0");
}

}  // namespace interpolated_motion::emulation
