#pragma once

#include <cstdint>

namespace interpolated_motion::emulation {

/// Where a motion begins and ends in the demand of a drive that interpolates all the time.
class MotionWatch {
 public:
  /// `rest`: so many samples without a change of the demand are the end of a motion, >= 1.
  explicit MotionWatch(std::int64_t rest) : rest_(rest) {}

  /// The next sample of the drive: whether it follows target positions, and its demand.
  void take(bool following, double demand);

  /// Whether the sample belongs to a motion.
  bool moving() const { return moving_; }
  /// Samples since the motion began, 0 for the first one; keeps its last value afterwards.
  std::int64_t samples() const { return samples_; }

 private:
  std::int64_t rest_;
  bool followed_ = false;
  double demand_ = 0.0;
  bool moving_ = false;
  std::int64_t stood_ = 0;
  std::int64_t samples_ = 0;
};

}  // namespace interpolated_motion::emulation
