#include "interpolated_motion_driver/axis/axis_notes.h"

#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::axis {

using namespace std::chrono_literals;

void AxisNotes::add(AxisNote note, HostTime now) {
  if (now >= second_begin_ + 1s || in_second_ == 0) {
    second_begin_ = now;
    in_second_ = 0;
  }
  if (in_second_ == kMost) {
    ++left_out_;
    return;
  }
  ++in_second_;
  if (left_out_ > 0) note.text += fmt::format(" ({} more before)", std::exchange(left_out_, 0));
  notes_.push_back(std::move(note));
}

AxisNote AxisNotes::take_oldest() {
  AxisNote note = std::move(notes_.front());
  notes_.pop_front();
  return note;
}

}  // namespace interpolated_motion::axis
