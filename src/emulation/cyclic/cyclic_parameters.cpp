#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"

#include <fmt/format.h>

#include <stdexcept>

#include "interpolated_motion_driver/emulation/limits.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::size_t kLongestName = 32;
constexpr HostDuration kShortestServoPeriod = std::chrono::microseconds(100);
constexpr HostDuration kLongestServoPeriod = std::chrono::milliseconds(10);
constexpr HostDuration kShortestBoot = std::chrono::milliseconds(1);

template <class Value>
void require(bool valid, const CyclicParameters& parameters, const char* name, const Value& value,
             const char* range) {
  if (valid) return;
  throw std::invalid_argument(fmt::format("emulated drive with node id {}: {} is {}, allowed is {}",
                                          parameters.node_id, name, value, range));
}

}  // namespace

void validate(const CyclicParameters& p) {
  require(p.node_id >= 1 && p.node_id <= 127, p, "node_id", p.node_id, "1..127");
  require(p.device_name.size() >= 1 && p.device_name.size() <= kLongestName, p, "device_name", p.device_name,
          "1..32 characters");
  require(p.clock_error_ppm >= -kLargestClockError && p.clock_error_ppm <= kLargestClockError, p,
          "clock_error_ppm", p.clock_error_ppm, "-100000..100000");
  require(p.servo_period >= kShortestServoPeriod && p.servo_period <= kLongestServoPeriod, p, "servo_period",
          p.servo_period.count(), "100000..10000000 ns");
  require(p.tick_phase >= HostDuration::zero() && p.tick_phase < p.servo_period, p, "tick_phase",
          p.tick_phase.count(), "0 ns to less than servo_period");
  require(p.boot_time >= kShortestBoot, p, "boot_time", p.boot_time.count(), "1000000 ns or more");
  require(p.sdo_response_time >= HostDuration::zero(), p, "sdo_response_time", p.sdo_response_time.count(),
          "0 ns or more");
  require(p.sync_gain > 0.0 && p.sync_gain <= 1.0, p, "sync_gain", p.sync_gain, "above 0 to 1");
  require(p.interpolation_order >= 1 && p.interpolation_order <= 3, p, "interpolation_order",
          p.interpolation_order, "1..3");
  require(p.ride_through >= 0 && p.ride_through <= 100, p, "ride_through", p.ride_through, "0..100");
  require(p.velocity_unit > 0.0, p, "velocity_unit", p.velocity_unit, "above 0");
  require(p.acceleration_per_torque >= 0.0, p, "acceleration_per_torque", p.acceleration_per_torque,
          "0 or more");
  require(p.plant.lag_ms >= 0.0, p, "plant.lag_ms", p.plant.lag_ms, "0 or more");
}

}  // namespace interpolated_motion::emulation
