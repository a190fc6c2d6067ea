#include "interpolated_motion_driver/emulation/silverdust/segment_queue.h"

namespace interpolated_motion::emulation {

bool SegmentQueue::push(const VelocitySegment& segment) {
  if (size_ == ring_.size()) {
    ++refused_;
    return false;
  }
  ring_[(head_ + size_) % ring_.size()] = segment;
  ++size_;
  ++accepted_;
  return true;
}

VelocitySegment SegmentQueue::pop() {
  const VelocitySegment segment = ring_[head_];
  head_ = (head_ + 1) % ring_.size();
  --size_;
  return segment;
}

bool SegmentQueue::holds_end() const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (ring_[(head_ + i) % ring_.size()].time == 0) return true;
  }
  return false;
}

}  // namespace interpolated_motion::emulation
