#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::canopen {

/// Counts the answers to the SDO requests of one node id (CiA 301, 7.2.4.3): more answers than requests come
/// from more than one device. Looks at the beginning of transfers, which names its object.
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
  struct Exchange {
    std::uint32_t object = 0;  ///< index and sub-index, as on the wire; 0: none
    int requests = 0;
    int answers = 0;
  };

  std::array<Exchange, 2> last_{};  ///< the newest first: an answer may come when the next has been asked for
  std::uint64_t surplus_ = 0;
};

}  // namespace interpolated_motion::canopen
