#include "interpolated_motion_driver/axis/epos/record_feed.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::axis {

void RecordFeed::load(const encoding::PvtStream& stream, const FeedLimits& limits) {
  limits_ = limits;
  start_position_ = stream.start_counts;
  records_.clear();
  forgotten_ = 0;
  sent_ = 0;
  committed_ = 0;
  append(stream.records);
}

/// Behind what there is, and the record that ends the mode behind that.
void RecordFeed::append(const std::vector<PvtRecord>& records) {
  double end = duration();
  for (const PvtRecord& record : records) records_.push_back({record, end += record.time * 1e-3});
  records_.push_back({{final_position(), 0, 0}, end});
}

std::int32_t RecordFeed::final_position() const {
  return records_.empty() ? start_position_ : records_.back().record.position;
}

const RecordFeed::Entry& RecordFeed::kept(std::size_t index) const {
  return records_[index - std::min(index, forgotten_)];
}

std::optional<PvtRecord> RecordFeed::next(double least_played, double played) const {
  if (all_sent() || !has_place(least_played) || !is_within_horizon(played)) return std::nullopt;
  return kept(sent_).record;
}

void RecordFeed::mark_sent() {
  if (++sent_ <= forgotten_ + kMemory) return;
  records_.pop_front();
  ++forgotten_;
}

void RecordFeed::commit(double until) {
  while (!all_committed() && (committed() == 0 || end(committed() - 1) < until)) committed_ = committed() + 1;
}

encoding::PvtKnot RecordFeed::committed_knot() const {
  if (committed() == 0) return {0, start_position_, 0};
  const Entry& last = kept(committed() - 1);
  return {std::llround(last.end * 1e3), last.record.position, last.record.velocity};
}

void RecordFeed::replace_uncommitted(const encoding::PvtStream& stream, const FeedLimits& limits) {
  limits_ = limits;
  records_.resize(committed() - forgotten_);
  append(stream.records);
}

RecordFeed RecordFeed::committed_part() const {
  RecordFeed part;
  part.limits_ = limits_;
  part.start_position_ = start_position_;
  part.records_.assign(records_.begin(),
                       records_.begin() + static_cast<std::ptrdiff_t>(committed() - forgotten_));
  part.forgotten_ = forgotten_;
  part.sent_ = sent_;
  part.committed_ = committed_;
  return part;
}

bool RecordFeed::has_place(double least_played) const {
  return sent_ - std::min(sent_, this->played(least_played)) + kSpare < limits_.capacity;
}

bool RecordFeed::is_within_horizon(double played) const {
  if (sent_ < this->played(played) + kLeastAhead) return true;
  return dry(sent_) - played < limits_.horizon;
}

/// When a drive that has the first `count` records misses the next: as it begins the last one, it needs the
/// knot behind it.
double RecordFeed::dry(std::size_t count) const { return count < 2 ? 0.0 : end(count - 2); }

std::size_t RecordFeed::played(double elapsed) const {
  std::size_t count = std::min(played_, records_.size());
  while (count < records_.size() && records_[count].end <= elapsed) ++count;
  while (count > 0 && records_[count - 1].end > elapsed) --count;
  played_ = count;
  return forgotten_ + count;
}

double RecordFeed::time_ahead(double elapsed) const {
  return sent_ == 0 ? 0.0 : std::max(0.0, end(sent_ - 1) - elapsed);
}

// On its way from one record to the next the velocity is a quadratic, and never beyond its Bernstein
// coefficients: both ends, and thrice the mean less the ends.
double RecordFeed::fastest_ahead(double elapsed, double unit) const {
  double fastest = 0.0;
  for (std::size_t i = played(elapsed); i < sent_; ++i) {
    const PvtRecord from = i == 0 ? PvtRecord{start_position_, 0, 0} : kept(i - 1).record;
    const PvtRecord& to = kept(i).record;
    if (to.time == 0) break;
    const double mean = (static_cast<double>(to.position) - from.position) / (1e-3 * to.time);
    const double ends = unit * (static_cast<double>(from.velocity) + to.velocity);
    fastest = std::max(
        {fastest, std::abs(unit * from.velocity), std::abs(3.0 * mean - ends), std::abs(unit * to.velocity)});
  }
  return fastest;
}

// Record i must be there when record i - 2 has been reached, so that the drive always finds two.
std::vector<RecordSlot> RecordFeed::slots(GoalTime start) const {
  const std::size_t places = limits_.capacity - kSpare;
  std::vector<RecordSlot> slots(size() - sent_);
  for (std::size_t i = sent_; i < size(); ++i) {
    RecordSlot& slot = slots[i - sent_];
    slot.deadline = start + GoalTime{dry(i)};
    const double place_free = i < places ? 0.0 : end(i - places);
    const double in_horizon = i < kLeastAhead ? 0.0 : dry(i) - limits_.horizon;
    const double soon_enough = i < kLeastAhead ? 0.0 : end(i - kLeastAhead);
    slot.release = start + GoalTime{std::max(place_free, std::min(in_horizon, soon_enough))};
  }
  return slots;
}

}  // namespace interpolated_motion::axis
