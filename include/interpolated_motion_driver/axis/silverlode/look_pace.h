#pragma once

#include "interpolated_motion_driver/axis/silverlode/drive_commands.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Time of the line that a question to a drive in motion takes: on the average, and the longest.
HostDuration look_time(const silverlode::LineMaster& line);
HostDuration longest_look_time(const silverlode::LineMaster& line);

/// How often a drive in motion is asked, so that the questions to all drives of a line leave the segments
/// their share of it. All times follow from what an exchange takes on this line, whose drives may answer
/// later than is planned with: they change as that is seen.
class LookPace {
 public:
  /// All must outlive this.
  LookPace(const SilverlodeAxisParameters& parameters, const SilverlodeFacts& facts,
           const silverlode::LineMaster& line)
      : parameters_(parameters), facts_(facts), line_(line) {}

  /// Between two questions to a drive on a line with nothing better to do: `status_period`, or as long as a
  /// round to all drives takes.
  HostDuration period() const;
  /// After which a question no longer waits for segments: a third of `feedback_timeout`, since a line that is
  /// slower than planned has always a segment waiting, every other question is for the position, and an
  /// answer takes its time. Longer, up to three times that, where the questions would take more of the line
  /// than the segments leave.
  HostDuration overdue() const;
  /// Longest silence of position reports in motion: `feedback_timeout`, or as long as it takes to ask for the
  /// position, which one question of two or three is for.
  HostDuration feedback_timeout() const;

 private:
  const SilverlodeAxisParameters& parameters_;
  const SilverlodeFacts& facts_;
  const silverlode::LineMaster& line_;
};

}  // namespace interpolated_motion::axis
