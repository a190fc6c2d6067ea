#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::canopen {

/// Counts the answers to the SDO requests of one node id (CiA 301, 7.2.4.3): more answers than requests come
/// from more than one device. An answer that has been missed may come late, so it is one to be expected.
/// Looks at the beginning of transfers.
class SdoAnswers {
 public:
  /// A request to the node is about to go out, or has been sent by another master.
  void on_request(const Frame& frame);
  /// The node has answered.
  void on_answer(const Frame& frame);

  /// Answers that nobody has asked for. One alone proves nothing: CAN delivers a frame twice when a receiver
  /// finds an error in its last bit but one.
  std::uint64_t surplus() const { return surplus_; }

 private:
  int open_ = 0;  ///< requests without an answer so far: it may be late
  std::uint64_t surplus_ = 0;
};

}  // namespace interpolated_motion::canopen
