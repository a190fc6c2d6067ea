#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// SYNC without counter: identifier 0x080, no data (CiA 301, 7.2.5). EPOS2 allows no other identifier
/// (0x1005).
Frame sync_frame();

/// When periodic SYNC frames are due. (`Master::request_sync` sends one at any other time.)
class SyncProducer {
 public:
  /// `period`: zero or less means none.
  explicit SyncProducer(HostDuration period = HostDuration::zero()) : period_(period) {}

  /// Whether a periodic SYNC is due. The first is due one period after the first call; the grid stays fixed
  /// (a late call does not move it), and periods missed altogether are skipped.
  bool poll(HostTime now);

  /// When the next periodic SYNC is due; `kNever` when off or before the first call of `poll`.
  HostTime next_deadline() const { return next_; }

  /// Instant of the grid for which `poll` returned true last.
  HostTime last_due() const { return next_ - period_; }
  /// Periods that `poll` skipped then, and the first instant for which it had not returned true before.
  std::uint64_t missed() const { return missed_; }
  HostTime first_due() const { return last_due() - static_cast<HostDuration::rep>(missed_) * period_; }

 private:
  HostDuration period_;
  HostTime next_ = kNever;
  std::uint64_t missed_ = 0;
};

/// `time` as a high resolution time stamp carries it: us of the host's clock, modulo 2^32 (CiA 301, object
/// 1013h); it begins anew every 71 min 35 s.
std::uint32_t time_stamp_of(HostTime time);

/// The time stamp of a SYNC that ended on the bus at `sync`, for the drives' object 0x1013 (mapped alone,
/// 4 bytes); `host` is the master's node id.
Frame time_stamp_frame(std::uint8_t host, HostTime sync);

}  // namespace interpolated_motion::canopen
