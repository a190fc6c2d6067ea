#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace interpolated_motion::tools {

Progress::Progress(double duration) : duration_(duration), terminal_(isatty(STDOUT_FILENO) == 1) {}

void Progress::feedback(const control_msgs::FollowJointTrajectoryFeedback& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  time_ = message.desired.time_from_start.toSec();
}

void Progress::buffers(const interpolated_motion_driver::BufferStatus& message) {
  if (message.fill.empty()) return;
  const auto least = std::min_element(message.fill_time.begin(), message.fill_time.end());
  const auto joint = static_cast<std::size_t>(least - message.fill_time.begin());
  const std::lock_guard<std::mutex> lock(mutex_);
  fill_ = Fill{message.name[joint], *least, message.fill[joint], message.capacity[joint]};
}

void Progress::show() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double share = duration_ > 0.0 ? std::min(std::max(time_ / duration_, 0.0), 1.0) : 1.0;
  const int step = terminal_ ? 1 : 10;
  const int percent = static_cast<int>(100.0 * share) / step * step;
  if (!terminal_ && percent == shown_percent_) return;
  shown_percent_ = percent;
  std::string line =
      fmt::format("{:3d} %  {:.1f} of {:.1f} s", percent, std::min(time_, duration_), duration_);
  if (fill_) {
    line += fmt::format("  buffers >= {:.2f} s ({}: {} of {} records)", fill_->time, fill_->joint,
                        fill_->records, fill_->capacity);
  }
  std::fputs((terminal_ ? "\r" + line + "   " : line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void Progress::finish() {
  if (terminal_) std::puts("");
}

}  // namespace interpolated_motion::tools
