#include "interpolated_motion_driver/motion/axes.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace interpolated_motion::motion {

namespace {

/// Longest from the start signal to the host's knowing when it was on the bus, a stall of the host included.
constexpr GoalTime kSignalAllowance{0.1};

}  // namespace

void signal_all(const Signals& signals, HostTime now) {
  for (axis::StartSignal* signal : signals) signal->signal(now);
}

bool all_are(const Axes& axes, axis::AxisState state) {
  return std::all_of(axes.begin(), axes.end(), [state](const axis::Axis* a) { return a->state() == state; });
}

bool any_is(const Axes& axes, axis::AxisState state) {
  return std::any_of(axes.begin(), axes.end(), [state](const axis::Axis* a) { return a->state() == state; });
}

std::vector<trajectory::State> rest_states(const Axes& axes) {
  std::vector<trajectory::State> states;
  for (const axis::Axis* axis : axes) states.push_back({axis->rest_position(), 0.0, 0.0});
  return states;
}

bool have_reported_since(const Axes& axes, HostTime when) {
  return std::all_of(axes.begin(), axes.end(),
                     [when](const axis::Axis* a) { return a->feedback().time >= when; });
}

Expected<std::vector<axis::TailPtr>, Refusal> encode_ways_on(const Axes& axes,
                                                             const std::vector<trajectory::Path>& paths,
                                                             axis::Pace pace) {
  std::vector<axis::TailPtr> tails;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto tail = axes[i]->encoder_behind(pace)->encode(paths[i]);
    if (!tail) return tail.error();
    tails.push_back(std::move(tail.value()));
  }
  return tails;
}

bool begins_at_signal(const axis::Axis& axis) { return axis.start_lead() == GoalTime{0.0}; }

GoalTime longest_lead(const Axes& axes) {
  GoalTime longest{0.0};
  for (const axis::Axis* axis : axes) longest = std::max(longest, axis->start_lead());
  return longest;
}

GoalTime wait_after_signal(const Axes& axes) {
  const GoalTime lead = longest_lead(axes);
  return lead > GoalTime{0.0} ? lead + kSignalAllowance : lead;
}

GoalTime head_start(const Axes& axes) {
  const bool signal =
      std::any_of(axes.begin(), axes.end(), [](const axis::Axis* a) { return begins_at_signal(*a); });
  return signal ? wait_after_signal(axes) : longest_lead(axes);
}

GoalTime longest_stream_lead(const Axes& axes) {
  GoalTime longest{0.0};
  for (const axis::Axis* axis : axes) longest = std::max(longest, axis->stream_lead());
  return longest;
}

GoalTime oldest_playback(const Axes& axes, HostTime now) {
  GoalTime oldest{std::numeric_limits<double>::infinity()};
  for (const axis::Axis* axis : axes) oldest = std::min(oldest, axis->playback(now));
  return oldest;
}

std::optional<GoalTime> committed(const Axes& axes) {
  GoalTime latest{-std::numeric_limits<double>::infinity()};
  for (const axis::Axis* axis : axes) {
    const auto until = axis->committed();
    if (!until) return std::nullopt;
    latest = std::max(latest, *until);
  }
  return latest;
}

}  // namespace interpolated_motion::motion
