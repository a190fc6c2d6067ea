#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/silverlode/line_start.h"
#include "interpolated_motion_driver/axis/silverlode/power_stage.h"
#include "interpolated_motion_driver/protocol/silverlode/outcome.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Starts a loaded drive: by an IMS of its own, or together with all drives of its line.
class ImsStart {
 public:
  /// `common`: what starts the drives of the line together; null when each gets an IMS of its own. It and
  /// `stage` must outlive this.
  ImsStart(SilverlodePowerStage& stage, LineStart* common);

  /// Asks for the start, once a motion: the drive's own IMS is queued; a common start waits until all drives
  /// of the line have asked. What comes of it, take() and poll() tell.
  void ask();
  /// The drive does not start after all.
  void withdraw();
  /// Takes the outcome if it is that of the drive's own IMS.
  bool take(const silverlode::Outcome& outcome);
  /// Looks what has become of it. Returns why the drive has not started, or why that is not known: it only
  /// waits so far, so it can be stopped.
  std::optional<std::string> poll(HostTime now);

  /// When the last bit of the command was on the line; empty as long as that is not known.
  std::optional<HostTime> sent() const { return sent_; }
  /// The drive has said that it has begun.
  bool begun() const { return begun_; }

 private:
  std::optional<std::string> poll_common(HostTime now);
  CommandSequence::Step check_begun();

  SilverlodePowerStage& stage_;
  LineStart* common_;
  std::size_t member_ = 0;  ///< of common_
  silverlode::RequestId own_ = silverlode::kNoRequest;
  std::optional<HostTime> sent_;
  bool begun_ = false;
  std::optional<std::string> failure_;
};

}  // namespace interpolated_motion::axis
