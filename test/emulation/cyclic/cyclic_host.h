#pragma once

#include <vector>

#include "emulation/canopen/wire_host.h"

namespace interpolated_motion::emulation {

/// A host of the cyclic synchronous position mode: RPDO1 as mapped by default (controlword and target
/// position, obeyed at SYNC), sent half a period before its SYNC.
class CyclicHost : public WireHost {
 public:
  static constexpr double kPeriodMs = 10.0;

  explicit CyclicHost(const CyclicParameters& parameters = {}) : WireHost(parameters) {
    cyclic->set_sample_observer([this](const CyclicSample& sample) { samples.push_back(sample); });
  }

  /// Up to Operation enabled in mode 8, on a SYNC raster that begins now.
  void prepare() {
    boot();
    ASSERT_EQ(write(0x6060, 0, 8, 1), 0U);
    nmt(1);
    control(0x06);
    control(0x0F);
    samples.clear();
    seen.clear();
    start = world.now();
  }

  HostTime sync_time(int n) const { return start + ms((n + 1) * kPeriodMs); }

  /// Time at which the n-th SYNC has arrived: 48 bits, without the interframe space.
  HostTime sync_arrival(int n) const { return sync_time(n) + std::chrono::microseconds(48); }

  void target(std::int32_t position, unsigned control = 0x0F) {
    const auto p = static_cast<std::uint32_t>(position);
    send(0x200U + node, {control, 0, p & 0xFF, p >> 8 & 0xFF, p >> 16 & 0xFF, p >> 24});
  }

  /// One whole cycle: target, SYNC number `n`; ends with that SYNC on its way.
  void cycle(int n, std::int32_t position, double sync_delay_ms = 0.0) {
    run_to(sync_time(n) - ms(kPeriodMs / 2));
    target(position);
    run_to(sync_time(n) + ms(sync_delay_ms));
    sync();
  }

  void sync() { send(0x080, {}); }

  HostTime start{};
  std::vector<CyclicSample> samples;  ///< all since prepare()
};

/// A cyclic drive whose axis is exactly where the demand is.
inline CyclicParameters stiff_cyclic() {
  CyclicParameters parameters;
  parameters.plant.lag_ms = 0.0;
  return parameters;
}

inline double ms_between(HostTime from, HostTime to) { return seconds(to - from) * 1e3; }

/// Constant velocity of 10 counts/ms, which every order extrapolates exactly.
inline constexpr int kStep = 100;

/// Demand of that motion: target 100 n takes effect at SYNC n and is reached a period later.
inline double ramp_demand(const CyclicHost& host, HostTime time) {
  return 10.0 * ms_between(host.sync_arrival(1), time);
}

}  // namespace interpolated_motion::emulation
