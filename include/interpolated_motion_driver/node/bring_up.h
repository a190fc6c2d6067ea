#pragma once

#include "interpolated_motion_driver/motion/snapshot.h"

namespace interpolated_motion::node {

/// Watches the group through its bring-up: done when the drives are configured and, if they are to be
/// enabled, when that has ended, well or in a fault. Only then are goals invited, so that a client that has
/// waited for the action can send at once.
class BringUp {
 public:
  /// `enable_on_start`: whether the bring-up is to end with the drives enabled.
  explicit BringUp(bool enable_on_start) : enable_on_start_(enable_on_start) {}

  /// Takes the present state. True from the end of the bring-up on.
  bool update(motion::GroupState state);

 private:
  bool ended_in(motion::GroupState state) const;

  const bool enable_on_start_;
  bool was_enabling_ = false;
  bool done_ = false;
};

}  // namespace interpolated_motion::node
