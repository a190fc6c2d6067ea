#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/protocol/canopen/node_link.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The records of a feed on their way onto the bus, as the FIFO has room for them by the clock.
class RecordSender {
 public:
  /// All must outlive the sender.
  RecordSender(canopen::NodeLink& node, RecordFeed& feed, const PlaybackClock& clock)
      : node_(node), feed_(feed), clock_(clock) {}

  /// From now on records count that have been on the bus.
  void begin();
  /// Gives the bus the records that are due.
  void send(HostTime now);
  /// Takes back what has not been on the bus yet.
  void withdraw() { node_.clear_records(); }

  /// Everything that was sent has been on the bus, the last of it at last_time().
  bool all_on_bus() const;
  HostTime last_time() const;
  std::uint64_t sent() const { return sent_; }  ///< since the start

 private:
  canopen::NodeLink& node_;
  RecordFeed& feed_;
  const PlaybackClock& clock_;
  std::uint64_t due_ = 0;  ///< confirmations of the RPDO after which all records sent are on the bus
  std::uint64_t sent_ = 0;
};

}  // namespace interpolated_motion::axis
