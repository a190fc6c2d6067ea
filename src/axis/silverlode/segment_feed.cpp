#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpolated_motion_driver/interpolation/ims_profile.h"

namespace interpolated_motion::axis {

SegmentFeed::Source::Source(const trajectory::Path& p, const Manner& manner, const encoding::ImsKnot& from)
    : path(p), encoding(manner.encoding), horizon(manner.horizon), encoder(path, encoding, from) {}

void SegmentFeed::load(const trajectory::Path& path, const Manner& manner, std::int32_t start_counts,
                       std::size_t depth) {
  const encoding::ImsEncoding& encoding = manner.encoding;
  widest_ = encoding.bound_counts;
  shortest_ = encoding.min_segment_ticks * 8 / 10;
  start_goal_time_ = path.start_time();
  take(std::make_unique<Source>(
      path, manner,
      encoding::ImsKnot{0, start_goal_time_, interpolation::ims_at_rest(encoding.law(), start_counts)}));
  start_counts_ = start_counts;
  depth_ = depth;
  tick_ = encoding.scale.tick;
  encoded_.clear();
  stretches_.clear();
  sent_ = 0;
  end_tick_ = 0;
  waited_ = 0;
  terminated_ = false;
}

void SegmentFeed::take(std::unique_ptr<Source> source) {
  source_ = std::move(source);
  const double final_position = source_->path.final_position();
  final_counts_ =
      static_cast<std::int32_t>(std::lround(source_->encoding.transmission.counts(final_position)));
}

std::vector<double> SegmentFeed::begins_before_knot(std::size_t most) const {
  const double origin = knot_goal_time().count() - knot_end();
  std::vector<double> begins;
  const std::size_t remembered = std::min(most, stretches_.size());
  for (auto it = stretches_.end() - static_cast<std::ptrdiff_t>(remembered); it != stretches_.end(); ++it)
    begins.push_back(origin + tick_ * static_cast<double>(it->begin));
  for (const Stretch& stretch : encoded_)
    begins.push_back(origin + tick_ * static_cast<double>(stretch.begin));
  begins.push_back(knot_goal_time().count());
  return begins;
}

void SegmentFeed::take_way_on(std::unique_ptr<Source> way_on, double widest) {
  widest_ = widest;
  take(std::move(way_on));
}

void SegmentFeed::commit(GoalTime until, double rate) {
  while (!ending() && knot_goal_time() < until) {
    if (encode_one(rate)) return;
  }
}

const trajectory::Path& SegmentFeed::path() const { return source_->path; }

void SegmentFeed::wait(std::int64_t ticks) {
  const ImsSegment standing{static_cast<std::int32_t>(ticks), start_counts_, 0, 0};
  encoded_.push_back({knot_tick(), ticks, start_goal_time_, 0.0, standing, knot().state});
  last_ = standing;
  waited_ += ticks;
}

Expected<ImsSegment, Refusal> SegmentFeed::next(double rate) {
  if (encoded_.empty()) {
    if (auto refusal = encode_one(rate)) return *refusal;
  }
  return encoded_.front().segment;
}

std::optional<Refusal> SegmentFeed::encode_one(double rate) {
  take_bound();
  Stretch stretch{knot_tick(), 0, knot_goal_time(), rate, {}, knot().state};
  std::optional<Refusal> refusal = encode_next(rate, stretch);
  // At another rate than it was tried out with, a way on may become too narrow.
  while (refusal && 2.0 * source_->encoding.bound_counts <= widest_) {
    encoding::ImsEncoding wider = source_->encoding;
    wider.bound_counts *= 2.0;
    encode_as(wider);
    refusal = encode_next(rate, stretch);
  }
  // A shortest segment has time for the worst that a line may do at once: a goal under way is worth a part of
  // that.
  while (refusal && source_->encoding.min_segment_ticks > shortest_) {
    encoding::ImsEncoding shorter = source_->encoding;
    shorter.min_segment_ticks = std::max(shortest_, shorter.min_segment_ticks * 9 / 10);
    encode_as(shorter);
    refusal = encode_next(rate, stretch);
  }
  if (refusal) return refusal;
  last_ = stretch.segment;
  encoded_.push_back(stretch);
  return std::nullopt;
}

/// What is left of the path is encoded in another way, from the knot on.
void SegmentFeed::encode_as(const encoding::ImsEncoding& encoding) {
  Manner manner{encoding, horizon()};
  auto source = std::make_unique<Source>(source_->path, manner, knot());
  source->bounds = std::move(source_->bounds);
  take(std::move(source));
}

/// The bound that was planned for what begins at the knot.
void SegmentFeed::take_bound() {
  std::optional<double> bound;
  auto& bounds = source_->bounds;
  for (; !bounds.empty() && bounds.front().time <= knot_goal_time(); bounds.pop_front())
    bound = bounds.front().counts;
  if (!bound) return;
  encoding::ImsEncoding encoding = source_->encoding;
  encoding.bound_counts = *bound;
  encode_as(encoding);
}

std::optional<Refusal> SegmentFeed::encode_next(double rate, Stretch& stretch) {
  encoding::ImsEncoder& encoder = source_->encoder;
  if (encoder.finished()) {
    stretch.segment = encoding::ims_terminator(last_);
    return std::nullopt;
  }
  encoder.set_rate(rate);
  encoding::ImsCertificate certificate;
  const auto more = encoder.next(stretch.segment, certificate);
  if (!more) return more.error();
  stretch.ticks = stretch.segment.time;
  stretch.rate = encoder.rate();
  return std::nullopt;
}

void SegmentFeed::mark_sent() {
  const Stretch& next = encoded_.front();
  terminated_ = next.segment.time == 0;
  stretches_.push_back(next);
  forget_old_stretches();
  end_tick_ += next.ticks;
  ++sent_;
  encoded_.pop_front();
}

void SegmentFeed::forget_old_stretches() {
  if (stretches_.size() > kMemory) stretches_.pop_front();
}

/// Index among `stretches_` of the segment executed at `elapsed`.
std::size_t SegmentFeed::executing(double elapsed) const {
  if (stretches_.empty()) return 0;
  const auto tick = static_cast<std::int64_t>(std::floor(elapsed / tick_));
  std::size_t i = std::min(executing_, stretches_.size() - 1);
  while (i + 1 < stretches_.size() && stretches_[i + 1].begin <= tick) ++i;
  while (i > 0 && stretches_[i].begin > tick) --i;
  executing_ = i;
  return i;
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

double SegmentFeed::begin_of(std::size_t number) const {
  const std::size_t forgotten = sent_ - stretches_.size();
  return tick_ * static_cast<double>(stretches_[number - forgotten].begin);
}

std::optional<SegmentFeed::Instant> SegmentFeed::instant_of(std::int64_t ticks_left, double expected) const {
  const Stretch* nearest = nullptr;
  double elapsed = 0.0;
  const std::size_t recent = std::min(stretches_.size(), kRecent);
  for (auto it = stretches_.end() - static_cast<std::ptrdiff_t>(recent); it != stretches_.end(); ++it) {
    if (ticks_left < 1 || ticks_left > it->ticks) continue;
    const double then = tick_ * static_cast<double>(it->begin + it->ticks - ticks_left);
    if (nearest != nullptr && std::abs(then - expected) >= std::abs(elapsed - expected)) continue;
    nearest = &*it;
    elapsed = then;
  }
  if (nearest == nullptr) return std::nullopt;
  return after(*nearest, nearest->ticks - ticks_left);
}

SegmentFeed::Instant SegmentFeed::after(const Stretch& stretch, std::int64_t ticks) const {
  const interpolation::ImsScale law = source_->encoding.law();
  interpolation::ImsProfile profile(law, stretch.from);
  profile.load(stretch.segment);
  for (std::int64_t k = 0; k < ticks; ++k) profile.tick();
  const interpolation::ImsState& state = profile.state();
  return {tick_ * static_cast<double>(stretch.begin + ticks), stretch.segment,
          interpolation::ims_register(interpolation::ims_nearest_count(law, state)),
          std::abs(static_cast<double>(state.velocity)) * law.counts_per_unit()};
}

std::int64_t SegmentFeed::knot_tick() const {
  return encoded_.empty() ? end_tick_ : encoded_.back().begin + encoded_.back().ticks;
}

double SegmentFeed::knot_end() const { return tick_ * static_cast<double>(knot_tick()); }

GoalTime SegmentFeed::goal_time_at(double drive_seconds) const {
  if (!source_) return GoalTime{0.0};
  const double path_begin = tick_ * static_cast<double>(waited_);
  if (stretches_.empty() || drive_seconds < path_begin)
    return start_goal_time_ + GoalTime{drive_seconds - path_begin};
  const Stretch& stretch = stretches_[executing(drive_seconds)];
  // The last tick of waiting and the first one of the path are the same instant.
  if (stretch.rate == 0.0) return stretch.goal_begin + GoalTime{drive_seconds - path_begin};
  const double since = drive_seconds - tick_ * static_cast<double>(stretch.begin);
  return stretch.goal_begin + GoalTime{since * stretch.rate};
}

}  // namespace interpolated_motion::axis
