#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include <control_msgs/FollowJointTrajectoryFeedback.h>
#include <interpolated_motion_driver/BufferStatus.h>

namespace interpolated_motion::tools {

/// Shows how far a goal has come: one line that is rewritten on a terminal, a new line per tenth elsewhere.
class Progress {
 public:
  /// `duration`: s, of the goal.
  explicit Progress(double duration);

  void feedback(const control_msgs::FollowJointTrajectoryFeedback& message);
  void buffers(const interpolated_motion_driver::BufferStatus& message);

  /// Shows what has arrived since the last call.
  void show();
  /// Ends the line.
  void finish();

 private:
  /// Of the buffer that runs dry first.
  struct Fill {
    std::string joint;
    double time = 0.0;  ///< s
    std::uint32_t records = 0;
    std::uint32_t capacity = 0;
  };

  const double duration_;
  const bool terminal_;
  std::mutex mutex_;
  double time_ = 0.0;
  std::optional<Fill> fill_;
  int shown_percent_ = -1;
};

}  // namespace interpolated_motion::tools
