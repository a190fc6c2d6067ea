#include "interpolated_motion_driver/node/periodic_calls.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::node {

void PeriodicCalls::add(double rate, std::function<void()> function) {
  const HostDuration period = host_duration(1.0 / rate);
  calls_.push_back({period, origin_ + period, std::move(function)});
}

void PeriodicCalls::poll(HostTime now) {
  for (Call& call : calls_) {
    if (now < call.due) continue;
    call.due += ((now - call.due) / call.period + 1) * call.period;
    call.function();
  }
}

HostTime PeriodicCalls::next_deadline() const {
  HostTime next = kNever;
  for (const Call& call : calls_) next = std::min(next, call.due);
  return next;
}

}  // namespace interpolated_motion::node
