#pragma once

#include <functional>
#include <vector>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// Functions that one thread calls at fixed rates. All count from the same origin, so calls whose periods
/// divide each other fall on the same instants and cost the thread one wake-up.
class PeriodicCalls {
 public:
  /// Periods are counted from `origin`.
  explicit PeriodicCalls(HostTime origin) : origin_(origin) {}

  /// `rate`: Hz, above 0. First called one period after the origin.
  void add(double rate, std::function<void()> function);

  /// Calls what is due at `now`, each function once: periods that have been missed are left out.
  void poll(HostTime now);

  /// When poll() has something to call, or kNever.
  HostTime next_deadline() const;

 private:
  struct Call {
    HostDuration period;             ///< above 0
    HostTime due;                    ///< when it is called next, a multiple of `period` after the origin
    std::function<void()> function;  ///< called by poll(), on its caller's thread
  };

  const HostTime origin_;
  std::vector<Call> calls_;
};

}  // namespace interpolated_motion::node
