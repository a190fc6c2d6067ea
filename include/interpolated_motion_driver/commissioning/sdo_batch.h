#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::commissioning {

/// One object of one node to be read, or to be written where there are bytes.
struct SdoOrder {
  std::uint8_t node = 0;                          ///< 1..127
  canopen::ObjectAddress address;                 ///< in that node
  std::optional<std::vector<std::uint8_t>> data;  ///< to be written, least significant byte first
};

/// Many SDO transfers with many nodes, sans-IO: those of one node one after the other, in the order given;
/// those of several nodes side by side. A read without an answer is tried once more; a write is not, since
/// the drive may have it. The other orders of a node that stays silent fail at once with the same result.
class SdoBatch {
 public:
  static constexpr std::size_t kSideBySide = 16;  ///< nodes asked at a time

  /// Throws std::invalid_argument for a node id out of range.
  SdoBatch(std::vector<SdoOrder> orders, const canopen::SdoParameters& parameters);

  /// All orders have their result.
  bool done() const { return finished_ == orders_.size(); }
  std::size_t finished() const { return finished_; }  ///< orders with a result
  /// In the order of the orders; those not finished yet are empty.
  const std::vector<canopen::SdoResult>& results() const { return results_; }

  /// Next frame to send, if there is one. Its time-out runs from here.
  std::optional<canopen::Frame> next_frame(HostTime now);
  /// A frame with the COB-ID of an SDO response, of any node.
  void on_frame(const canopen::Frame& frame, HostTime now);
  /// Ends what has had no answer in time, and starts what is next.
  void poll(HostTime now);
  /// When `poll` must be called next; kNever when done.
  HostTime next_deadline() const;

 private:
  struct Running {
    std::size_t order;          ///< index into `orders_`
    int attempts;               ///< so far, this one included
    canopen::SdoClient client;  ///< busy
  };

  void start(Running& running, HostTime now) const;
  void start_waiting(HostTime now);
  bool is_running(std::uint8_t node) const;
  bool end_of(Running& running, HostTime now);
  void finish(std::size_t order, const canopen::SdoResult& result);
  void give_up(const canopen::SdoResult& silent);

  std::vector<SdoOrder> orders_;
  canopen::SdoParameters parameters_;
  std::vector<canopen::SdoResult> results_;
  std::deque<std::size_t> waiting_;  ///< indices into `orders_`
  std::vector<Running> running_;
  std::deque<canopen::Frame> closing_;  ///< last frames of transfers that have ended
  std::size_t finished_ = 0;
};

}  // namespace interpolated_motion::commissioning
