#include "interpolated_motion_driver/protocol/canopen/sync.h"

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {

Frame sync_frame() {
  Frame frame;
  frame.id = cob_id::kSync;
  return frame;
}

std::uint32_t time_stamp_of(HostTime time) {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
  return static_cast<std::uint32_t>(us);
}

Frame time_stamp_frame(std::uint8_t host, HostTime sync) {
  Frame frame;
  frame.id = cob_id::time_stamp(host);
  frame.length = sizeof(std::uint32_t);
  put_le(frame.data.data(), time_stamp_of(sync));
  return frame;
}

bool SyncProducer::poll(HostTime now) {
  if (period_ <= HostDuration::zero()) return false;
  if (next_ == kNever) {
    next_ = now + period_;
    return false;
  }
  if (now < next_) return false;
  const HostDuration::rep missed = (now - next_) / period_;
  missed_ = static_cast<std::uint64_t>(missed);
  next_ += period_ * (missed + 1);
  return true;
}

}  // namespace interpolated_motion::canopen
