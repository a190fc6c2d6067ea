#include <algorithm>
#include <cmath>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

// A path that is still being made: it may change behind the segment that has been encoded last.

namespace {

/// Longest segment of a stream, as multiple of the shortest one: a segment is committed as a whole.
constexpr std::int64_t kLongest = 2;

}  // namespace

encoding::ImsEncoding SilverlodeAxis::stream_encoding() const {
  encoding::ImsEncoding encoding = this->encoding();
  const double round = static_cast<double>(line_.device_count()) * delivery_->record_bus_time();
  const auto shortest = static_cast<std::int64_t>(std::ceil(round / tick()));
  encoding.min_segment_ticks = std::max(encoding.min_segment_ticks, shortest);
  encoding.max_segment_ticks = kLongest * encoding.min_segment_ticks;
  return encoding;
}

double SilverlodeAxis::horizon() const {
  return stream_origin_ ? parameters_.stream_horizon : parameters_.commit_horizon;
}

std::optional<Refusal> SilverlodeAxis::plan_stream(HostTime origin, GoalTime rest) {
  planned_path_ = trajectory::with_rest(trajectory::Path(rest_position()), rest);
  planned_slots_.clear();
  planned_origin_ = origin;
  return std::nullopt;
}

GoalTime SilverlodeAxis::stream_lead() const {
  const double longest = tick() * static_cast<double>(stream_encoding().max_segment_ticks);
  return GoalTime{std::max(parameters_.stream_horizon, kLeastAhead * longest) + longest};
}

HostTime SilverlodeAxis::committed() const {
  if (phase() != Phase::Moving || !stream_origin_ || !second_wait_made_ || feed_.ending()) return kNever;
  return *stream_origin_ + host_duration((stream_begin_ + feed_.knot_goal_time()).count());
}

std::optional<Refusal> SilverlodeAxis::plan_follow(const trajectory::Path& path) {
  const trajectory::Path own = trajectory::shifted(path, GoalTime{0.0} - stream_begin_);
  return feed_.plan_way_on(own, stream_encoding(), parameters_.stream_deviation_bound);
}

void SilverlodeAxis::follow() { feed_.take_way_on(); }

}  // namespace interpolated_motion::axis
