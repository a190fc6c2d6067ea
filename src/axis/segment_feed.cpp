#include "interpolated_motion_driver/axis/segment_feed.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::axis {

SegmentFeed::Source::Source(const trajectory::Path& p, const encoding::ImsEncoding& encoding,
                            std::int32_t start_counts)
    : path(p),
      encoder(path, encoding,
              {0, path.start_time(), interpolation::ims_at_rest(encoding.law(), start_counts)}) {}

void SegmentFeed::load(const trajectory::Path& path, const encoding::ImsEncoding& encoding,
                       std::int32_t start_counts, std::size_t depth) {
  source_ = std::make_unique<Source>(path, encoding, start_counts);
  encoding_ = encoding;
  start_counts_ = start_counts;
  final_counts_ = static_cast<std::int32_t>(std::lround(encoding.transmission.counts(path.final_position())));
  depth_ = depth;
  tick_ = encoding.scale.tick;
  next_.reset();
  stretches_.clear();
  sent_ = 0;
  end_tick_ = 0;
  waited_ = 0;
  terminated_ = false;
}

const trajectory::Path& SegmentFeed::path() const { return source_->path; }

void SegmentFeed::wait(std::int64_t ticks) {
  const ImsSegment standing{static_cast<std::int32_t>(ticks), start_counts_, 0, 0};
  next_ = Stretch{end_tick_, ticks, source_->path.start_time(), 0.0, standing};
  waited_ += ticks;
}

Expected<ImsSegment, Refusal> SegmentFeed::next(double rate) {
  if (next_) return next_->segment;
  Stretch stretch{end_tick_, 0, knot_goal_time(), rate, {}};
  if (source_->encoder.finished()) {
    stretch.segment = encoding::ims_terminator(last_);
  } else {
    source_->encoder.set_rate(rate);
    encoding::ImsCertificate certificate;
    const auto more = source_->encoder.next(stretch.segment, certificate);
    if (!more) return more.error();
    stretch.ticks = stretch.segment.time;
    stretch.rate = source_->encoder.rate();
  }
  next_ = stretch;
  return stretch.segment;
}

void SegmentFeed::mark_sent() {
  last_ = next_->segment;
  terminated_ = last_.time == 0;
  stretches_.push_back(*next_);
  forget_old_stretches();
  end_tick_ += next_->ticks;
  ++sent_;
  next_.reset();
}

void SegmentFeed::forget_old_stretches() {
  if (stretches_.size() > kMemory) stretches_.pop_front();
}

/// Index among `stretches_` of the segment executed at `elapsed`.
std::size_t SegmentFeed::executing(double elapsed) const {
  const auto tick = static_cast<std::int64_t>(std::floor(elapsed / tick_));
  const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), tick,
                                      [](std::int64_t t, const Stretch& s) { return t < s.begin; });
  return after == stretches_.begin() ? 0 : static_cast<std::size_t>(after - stretches_.begin()) - 1;
}

std::size_t SegmentFeed::waiting(double elapsed, bool started) const {
  if (!started || stretches_.empty()) return sent_;
  return stretches_.size() - 1 - executing(elapsed);
}

bool SegmentFeed::has_place(double least_elapsed, bool started) const {
  return waiting(least_elapsed, started) < depth_;
}

double SegmentFeed::next_begin(double elapsed) const {
  if (stretches_.empty()) return 0.0;
  const Stretch& now = stretches_[executing(elapsed)];
  return tick_ * static_cast<double>(now.begin + now.ticks);
}

double SegmentFeed::latest_end() const {
  return tick_ * static_cast<double>(end_tick_ + (next_ ? next_->ticks : 0));
}

double SegmentFeed::begin_of(std::size_t number) const {
  const std::size_t forgotten = sent_ - stretches_.size();
  return tick_ * static_cast<double>(stretches_[number - forgotten].begin);
}

std::optional<SegmentFeed::Instant> SegmentFeed::instant_of(std::int64_t ticks_left, double expected) const {
  std::optional<Instant> nearest;
  const std::size_t recent = std::min(stretches_.size(), kRecent);
  for (auto it = stretches_.end() - static_cast<std::ptrdiff_t>(recent); it != stretches_.end(); ++it) {
    const Stretch& stretch = *it;
    if (ticks_left < 1 || ticks_left > stretch.ticks) continue;
    const double elapsed = tick_ * static_cast<double>(stretch.begin + stretch.ticks - ticks_left);
    if (!nearest || std::abs(elapsed - expected) < std::abs(nearest->elapsed - expected))
      nearest = {elapsed, stretch.segment};
  }
  return nearest;
}

GoalTime SegmentFeed::knot_goal_time() const { return source_->encoder.knot().goal_time; }

GoalTime SegmentFeed::goal_time_at(double drive_seconds) const {
  if (!source_) return GoalTime{0.0};
  const double path_begin = tick_ * static_cast<double>(waited_);
  if (stretches_.empty() || drive_seconds < path_begin)
    return source_->path.start_time() + GoalTime{drive_seconds - path_begin};
  const Stretch& stretch = stretches_[executing(drive_seconds)];
  // The last tick of waiting and the first one of the path are the same instant.
  if (stretch.rate == 0.0) return stretch.goal_begin + GoalTime{drive_seconds - path_begin};
  const double since = drive_seconds - tick_ * static_cast<double>(stretch.begin);
  return stretch.goal_begin + GoalTime{since * stretch.rate};
}

}  // namespace interpolated_motion::axis
