#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// For how long an axis has been doing what it does, and its drive has told nothing, as far as the host was
/// there. Time limits are for the drive: what the host was away for, stopped or starved by other programs,
/// does not count.
class StageTime {
 public:
  /// The axis is polled. Returns for how long the host was away before, as far as that was within the stage
  /// or phase; zero mostly.
  HostDuration poll(HostTime now);
  HostTime polled() const { return polled_; }      ///< of the latest poll()
  HostTime returned() const { return returned_; }  ///< when the host was back after it had been away last

  /// A stage, or a phase within it, begins.
  void begin(HostTime now);
  HostTime since() const { return since_; }  ///< of the latest begin()
  /// `limit` is over since the stage or phase began.
  bool expired(HostTime now, HostDuration limit) const { return now - since_ - away_ > limit; }

  /// A position has come from the drive. To be called before poll() of the same instant: what came while the
  /// host was away is older.
  void note_report() { absent_at_report_ = absent_; }
  /// How long no position has come, the last one of `last`.
  HostDuration silence(HostTime now, HostTime last) const {
    return now - last - (absent_ - absent_at_report_);
  }

 private:
  HostTime since_{};
  HostDuration away_{};  ///< of the host, since then
  HostTime polled_{};
  HostTime returned_{};
  HostDuration absent_{};            ///< of the host, in all
  HostDuration absent_at_report_{};  ///< the same when the last position came
};

}  // namespace interpolated_motion::axis
