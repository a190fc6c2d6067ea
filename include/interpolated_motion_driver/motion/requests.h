#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/snapshot.h"

namespace interpolated_motion::motion {

/// What can be asked of a group. ShutDown differs from Disable in what is said to the goal that it ends,
/// ClearBuffers from Halt in its message: every stop leaves the FIFOs empty.
enum class RequestKind { Enable, Disable, ShutDown, ResetFaults, Halt, ClearBuffers };

/// Requests that wait until the group has reached the state they ask for.
class Requests {
 public:
  /// A new request, to be ended by finish() or settle(). Ids ascend from 1.
  RequestId add(RequestKind kind);
  /// Ends `id` at once.
  void finish(RequestId id, bool success, std::string message);
  /// Ends every request whose outcome `state` decides. `fault` is the reason of a Fault.
  void settle(GroupState state, const std::string& fault);
  /// The result of a request that has ended, oldest first.
  std::optional<RequestResult> take_result();

 private:
  struct Pending {
    RequestId id;      ///< as add() has returned it
    RequestKind kind;  ///< decides which states settle it
  };

  RequestId next_ = 1;
  std::vector<Pending> pending_;
  std::deque<RequestResult> results_;
};

}  // namespace interpolated_motion::motion
