#include "interpolated_motion_driver/protocol/canopen/sync.h"

#include "interpolated_motion_driver/protocol/canopen/cob_id.h"

namespace interpolated_motion::canopen {

Frame sync_frame() {
  Frame frame;
  frame.id = cob_id::kSync;
  return frame;
}

bool SyncProducer::poll(HostTime now) {
  if (period_ <= HostDuration::zero()) return false;
  if (next_ == kNever) {
    next_ = now + period_;
    return false;
  }
  if (now < next_) return false;
  next_ += period_ * ((now - next_) / period_ + 1);
  return true;
}

}  // namespace interpolated_motion::canopen
