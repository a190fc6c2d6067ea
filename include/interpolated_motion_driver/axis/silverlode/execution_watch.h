#pragma once

#include <limits>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/axis/silverlode/status.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Holds what a drive executes against what it was sent. The protocol has no checksum: a digit changed on the
/// line makes another segment, and the drive acknowledges it; so that goes unnoticed for a moment only: by
/// its numbers while it lasts, and by the drive's position ever after, since each segment begins where the
/// one before has led. What fits tells how far the drive has played.
class ExecutionWatch {
 public:
  /// All must outlive the watch.
  ExecutionWatch(const SilverlodeAxisParameters& parameters, const SegmentFeed& feed, PlaybackClock& clock)
      : parameters_(parameters), feed_(feed), clock_(clock) {}

  /// A motion begins.
  void begin() { misfits_ = strays_ = 0; }
  /// Returns why the motion cannot go on.
  std::optional<std::string> take(const SilverlodeStatus::Execution& look);
  /// Error of the drive's clock as the last motion has shown it, ppm; NaN while none has.
  double clock_error_ppm() const { return clock_error_ppm_; }
  /// Seconds of the drive's clock per second of the host's, as far as is known.
  double clock_rate() const;

 private:
  static std::optional<std::string> misfit(int& in_a_row, std::string text);
  std::optional<std::string> watch_position(const SilverlodeStatus::Execution& look,
                                            const SegmentFeed::Instant& instant);
  std::string stray_text(double off, bool demand) const;
  void learn_clock(HostTime asked, double elapsed);

  const SilverlodeAxisParameters& parameters_;
  const SegmentFeed& feed_;
  PlaybackClock& clock_;
  int misfits_ = 0;  ///< looks in a row at an execution that does not fit
  int strays_ = 0;   ///< the same, at a position that does not fit
  double clock_error_ppm_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace interpolated_motion::axis
