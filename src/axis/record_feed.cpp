#include "interpolated_motion_driver/axis/record_feed.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::axis {

void RecordFeed::load(encoding::PvtStream stream, const FeedLimits& limits) {
  stream_ = std::move(stream);
  limits_ = limits;
  sent_ = 0;
  ends_.clear();
  double end = 0.0;
  for (const PvtRecord& record : stream_.records) ends_.push_back(end += record.time * 1e-3);
  ends_.push_back(end);
}

PvtRecord RecordFeed::record(std::size_t index) const {
  if (index < stream_.records.size()) return stream_.records[index];
  const std::int32_t last = stream_.records.empty() ? stream_.start_counts : stream_.records.back().position;
  return {last, 0, 0};
}

std::optional<PvtRecord> RecordFeed::next(double least_played, double played) const {
  if (all_sent() || !has_place(least_played) || !is_within_horizon(played)) return std::nullopt;
  return record(sent_);
}

bool RecordFeed::has_place(double least_played) const {
  return sent_ - std::min(sent_, this->played(least_played)) + kSpare < limits_.capacity;
}

bool RecordFeed::is_within_horizon(double played) const {
  if (sent_ < this->played(played) + kLeastAhead) return true;
  return ends_[sent_ - 1] - played < limits_.horizon;
}

std::size_t RecordFeed::played(double elapsed) const {
  const auto after = std::upper_bound(ends_.begin(), ends_.end(), elapsed);
  return static_cast<std::size_t>(after - ends_.begin());
}

double RecordFeed::time_ahead(double elapsed) const {
  return sent_ == 0 ? 0.0 : std::max(0.0, ends_[sent_ - 1] - elapsed);
}

// Record i must be there when record i - 2 has been reached, so that the drive always finds two.
std::vector<RecordSlot> RecordFeed::slots(GoalTime start) const {
  const std::size_t places = limits_.capacity - kSpare;
  std::vector<RecordSlot> slots(ends_.size());
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    slots[i].deadline = start + GoalTime{i < 2 ? 0.0 : ends_[i - 2]};
    const double place_free = i < places ? 0.0 : ends_[i - places];
    const double in_horizon = i < kLeastAhead ? 0.0 : ends_[i - 1] - limits_.horizon;
    const double soon_enough = i < kLeastAhead ? 0.0 : ends_[i - kLeastAhead];
    slots[i].release = start + GoalTime{std::max(place_free, std::min(in_horizon, soon_enough))};
  }
  return slots;
}

}  // namespace interpolated_motion::axis
