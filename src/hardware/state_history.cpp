#include "interpolated_motion_driver/hardware/state_history.h"

#include <algorithm>

#include "interpolated_motion_driver/trajectory/hermite.h"

namespace interpolated_motion::hardware {

namespace {

/// A minute of looks, and some more at changes of state.
constexpr std::size_t kPlaces = 3300;
constexpr HostDuration kWindow = std::chrono::minutes(1);
/// Between two looks that lie further apart nothing is known.
constexpr HostDuration kLongestGap = std::chrono::milliseconds(100);

}  // namespace

StateHistory::StateHistory(std::size_t joints)
    : joints_(joints), times_(kPlaces), states_(kPlaces * joints) {}

void StateHistory::add(HostTime time, const std::vector<trajectory::State>& desired) {
  const bool again = count_ > 0 && times_[place(count_ - 1)] == time;
  if (!again && count_ == times_.size()) first_ = place(1);
  if (!again && count_ < times_.size()) ++count_;
  const std::size_t newest = place(count_ - 1);
  times_[newest] = time;
  std::copy(desired.begin(), desired.end(), states_.begin() + static_cast<std::ptrdiff_t>(newest * joints_));
}

const trajectory::State& StateHistory::state(std::size_t number, std::size_t joint) const {
  return states_[place(number) * joints_ + joint];
}

bool StateHistory::at(HostTime time, std::vector<trajectory::State>& out) const {
  if (count_ == 0 || time > times_[place(count_ - 1)] || time < times_[place(count_ - 1)] - kWindow)
    return false;
  std::size_t before = count_;  // the last one not after `time`
  for (std::size_t low = 0, high = count_; low < high;) {
    const std::size_t middle = low + (high - low) / 2;
    if (times_[place(middle)] <= time) {
      before = middle;
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (before == count_) return false;
  const HostTime begin = times_[place(before)];
  const std::size_t after = std::min(before + 1, count_ - 1);
  const HostDuration span = times_[place(after)] - begin;
  if (span > kLongestGap) return false;
  out.resize(joints_);
  for (std::size_t j = 0; j < joints_; ++j) {
    out[j] = state(before, j);
    if (time == begin) continue;
    out[j] = trajectory::cubic_hermite(state(before, j), state(after, j), seconds(span))
                 .state(seconds(time - begin));
  }
  return true;
}

}  // namespace interpolated_motion::hardware
