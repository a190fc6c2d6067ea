#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/trajectory/remainder.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

// A path that is still being made: what has not been sent yet is encoded anew whenever the path has changed.

namespace {

/// Longest record of a stream, ms: a record is committed as a whole.
constexpr std::int64_t kLongestRecord = 25;

}  // namespace

encoding::PvtEncoding EposAxis::stream_encoding() const {
  encoding::PvtEncoding encoding = this->encoding();
  encoding.max_record_ms = kLongestRecord;
  return encoding;
}

std::optional<Refusal> EposAxis::plan_stream(HostTime origin, GoalTime rest) {
  const trajectory::Path standing = trajectory::with_rest(trajectory::Path(rest_position()), rest);
  const auto stream = encoding::encode_pvt(standing, stream_encoding(), rest_counts_);
  if (!stream) return stream.error();
  planned_ = {};
  planned_.feed.load(stream.value(), {facts_.capacity, parameters_.stream_horizon});
  planned_.origin = origin;
  return std::nullopt;
}

GoalTime EposAxis::stream_lead() const {
  constexpr double kRecord = 1e-3 * kLongestRecord;
  const double kept = std::max(parameters_.stream_horizon, RecordFeed::kLeastAhead * kRecord);
  return GoalTime{kept + kRecord};
}

HostTime EposAxis::committed() const {
  if (phase() != Phase::Moving || !stream_origin_ || feed_.all_sent()) return kNever;
  const GoalTime knot = timeline_.at(1e-3 * static_cast<double>(feed_.sent_knot().sample));
  return *stream_origin_ + host_duration(knot.count());
}

/// Goal seconds that the drive will be behind when it has played so far.
double EposAxis::behind_at(double drive_seconds) const {
  const double due = seconds(clock_.host_time(drive_seconds) - *stream_origin_);
  return due - timeline_.at(drive_seconds).count();
}

// The knot sent last was chosen for another way on: within the bound of a goal there may be none.
std::optional<Refusal> EposAxis::plan_follow(const trajectory::Path& path) {
  const encoding::PvtKnot knot = feed_.sent_knot();
  const double from = 1e-3 * static_cast<double>(knot.sample);
  way_on_rate_ = clock_.goal_rate(behind_at(from));
  const trajectory::Path rest = trajectory::remainder(path, timeline_.at(from), way_on_rate_);
  encoding::PvtEncoding encoding = stream_encoding();
  auto stream = encoding::encode_pvt(rest, encoding, {0, knot.position, knot.velocity});
  while (!stream && 2.0 * encoding.bound_counts <= parameters_.stream_deviation_bound) {
    encoding.bound_counts *= 2.0;
    stream = encoding::encode_pvt(rest, encoding, {0, knot.position, knot.velocity});
  }
  if (!stream) return stream.error();
  way_on_ = std::move(stream.value());
  return std::nullopt;
}

void EposAxis::follow() {
  timeline_.change_rate(1e-3 * static_cast<double>(feed_.sent_knot().sample), way_on_rate_);
  feed_.replace_unsent(way_on_);
}

}  // namespace interpolated_motion::axis
