#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace interpolated_motion::emulation {

/// One velocity segment as the drive holds it, in the order of its four registers and of IMW ("Interpolated
/// Motion", Registers Used with Interpolated Motion).
struct VelocitySegment {
  std::int32_t time = 0;          ///< ticks; 0: last
  std::int32_t position = 0;      ///< counts
  std::int32_t acceleration = 0;  ///< 2^31 is the full scale; 0: constant velocity
  std::int32_t velocity = 0;      ///< 2^31 is the full scale
};

/// The FIFO behind IMQ and IMW ("Interpolated Motion", Host Based Control).
class SegmentQueue {
 public:
  /// `depth`: segments that can wait, not counting the one that is executed; 1 or more.
  explicit SegmentQueue(int depth) : ring_(static_cast<std::size_t>(depth)) {}

  /// IMW. False, and nothing is taken, when the queue is full.
  bool push(const VelocitySegment& segment);

  /// The segment that has waited longest leaves. The queue must not be empty.
  VelocitySegment pop();

  /// Segments that wait.
  int size() const { return static_cast<int>(size_); }

  /// Whether a segment with time 0 is waiting.
  bool holds_end() const;

  /// IMQ: nothing waits any more.
  void clear() { size_ = 0; }

  /// Segments that push() has taken and refused so far, whatever became of the queue.
  std::uint64_t accepted() const { return accepted_; }
  std::uint64_t refused() const { return refused_; }

 private:
  std::vector<VelocitySegment> ring_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace interpolated_motion::emulation
