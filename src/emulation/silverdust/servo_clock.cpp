#include "interpolated_motion_driver/emulation/silverdust/servo_clock.h"

#include <cmath>

namespace interpolated_motion::emulation {
namespace {

double true_period_ns(HostDuration tick, double ppm) {
  return static_cast<double>(tick.count()) / (1.0 + ppm * 1e-6);
}

}  // namespace

ServoClock::ServoClock(const SilverDustParameters& parameters, HostTime start)
    : tick_(parameters.tick), start_(start), period_ns_(true_period_ns(tick_, parameters.clock_error_ppm)) {}

void ServoClock::restart(HostTime start) {
  start_ = start;
  ticks_ = 0;
}

void ServoClock::set_error(double ppm) {
  restart(last());
  period_ns_ = true_period_ns(tick_, ppm);
}

HostTime ServoClock::time_of(std::int64_t tick) const {
  return start_ + HostDuration(std::llround(static_cast<double>(tick) * period_ns_));
}

std::int64_t ServoClock::due(HostTime now) const {
  if (now < start_) return 0;
  auto ticks = static_cast<std::int64_t>(static_cast<double>((now - start_).count()) / period_ns_);
  while (time_of(ticks + 1) <= now) ++ticks;
  while (ticks > 0 && time_of(ticks) > now) --ticks;
  return ticks;
}

}  // namespace interpolated_motion::emulation
