#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// The longest that a thread was busy without coming back to what waits for it, in the last minute or two.
class TurnTime {
 public:
  /// Of one turn, by the thread itself.
  void note(HostTime begin, HostTime end) {
    constexpr HostDuration kWindow = std::chrono::minutes(1);
    if (end - window_begin_ >= kWindow) {
      before_ = now_.exchange(HostDuration{0});
      window_begin_ = end;
    }
    now_ = std::max(now_.load(), end - begin);
  }

  /// From any thread.
  HostDuration longest() const { return std::max(before_.load(), now_.load()); }

 private:
  HostTime window_begin_{};
  std::atomic<HostDuration> before_{HostDuration{0}};
  std::atomic<HostDuration> now_{HostDuration{0}};
};

}  // namespace interpolated_motion::node
