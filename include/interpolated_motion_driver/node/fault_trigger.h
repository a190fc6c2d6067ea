#pragma once

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// Says when a recording of a fault is to be written: so long after the group has come into Fault that the
/// recording shows how the drives were stopped.
class FaultTrigger {
 public:
  static constexpr HostDuration kAfterFault = std::chrono::milliseconds(500);

  /// True once for each fault. Also when the group has left Fault meanwhile.
  bool update(motion::GroupState state, HostTime now) {
    const bool comes = state == motion::GroupState::Fault && !in_fault_;
    in_fault_ = state == motion::GroupState::Fault;
    if (comes && due_ == kNever) due_ = now + kAfterFault;
    if (now < due_) return false;
    due_ = kNever;
    return true;
  }
  /// A fault has not been told yet.
  bool is_pending() const { return due_ != kNever; }

 private:
  bool in_fault_ = false;
  HostTime due_ = kNever;
};

}  // namespace interpolated_motion::node
