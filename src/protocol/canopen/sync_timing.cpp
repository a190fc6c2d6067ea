#include "interpolated_motion_driver/protocol/canopen/sync_timing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace interpolated_motion::canopen {

void SyncTiming::confirm(HostTime due, HostTime end) {
  const double delay = seconds(end - due);
  ++confirmed_;
  // The mean of all as long as they are few.
  const double mean = delay_ + (delay - delay_) / std::min(static_cast<double>(confirmed_), kMemory);
  if (end - second_begin_ >= std::chrono::seconds(1)) {
    before_ = std::exchange(worst_, 0.0);
    second_begin_ = end;
  }
  if (confirmed_ > 1) worst_ = std::max(worst_, std::abs(delay - delay_));
  delay_ = mean;
}

void SyncTiming::leave_out(HostTime first, HostDuration period, std::uint64_t count) {
  const HostTime last = first + static_cast<HostDuration::rep>(count - 1) * period;
  const bool goes_on = first_left_out_ != kNever && first == last_left_out_ + period;
  const bool goes_before = last == first_left_out_ - period;
  if (!goes_on) first_left_out_ = first;
  if (!goes_before) last_left_out_ = last;
  skipped_ += count;
}

}  // namespace interpolated_motion::canopen
