#pragma once

#include <cstdint>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// Time from the last bit of a request to the first of its reply, as it comes: the mean of the latest
/// replies, older ones weigh less.
class ReplyDelay {
 public:
  void add(HostDuration delay) {
    mean_ = replies_ == 0 ? delay : mean_ + (delay - mean_) / kMemory;
    ++replies_;
  }

  HostDuration mean() const { return mean_; }

 private:
  static constexpr int kMemory = 32;  ///< replies

  HostDuration mean_{};
  std::uint64_t replies_ = 0;
};

}  // namespace interpolated_motion::silverlode
