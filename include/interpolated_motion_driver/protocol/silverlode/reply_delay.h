#pragma once

#include <optional>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// Time from the last bit of a request to the first of its reply, as it comes: the mean of the latest
/// replies, older ones weigh less.
class ReplyDelay {
 public:
  /// One more reply; the new one weighs 1/32, the first one 1.
  void add(HostDuration delay) { mean_ = mean_ ? *mean_ + (delay - *mean_) / kMemory : delay; }

  /// 0 before the first reply.
  HostDuration mean() const { return mean_.value_or(HostDuration::zero()); }

 private:
  static constexpr int kMemory = 32;  ///< replies

  std::optional<HostDuration> mean_;
};

}  // namespace interpolated_motion::silverlode
