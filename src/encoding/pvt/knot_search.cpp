#include "interpolated_motion_driver/encoding/pvt/knot_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "interpolated_motion_driver/encoding/record_range.h"

namespace interpolated_motion::encoding {

namespace {

/// Part of the bound that quick tests may use up: between their samples the deviation is a few per cent
/// greater.
constexpr double kCaution = 0.97;

/// Lengths tried: from the longest possible down to this part of it, in steps of a 24th.
constexpr double kShortestPart = 0.75;
constexpr std::int64_t kStepsPerLength = 24;

/// Retreats before a path is given up. Each shortens one record by a quarter, so a dead end left at all is
/// left early.
constexpr int kMaxRetreats = 256;

/// Greatest length in 1..longest for which `feasible` holds, 0 if none, taking it to hold up to some length
/// and not beyond. Gallops from `guess`, then bisects.
template <class Feasible>
std::int64_t longest_feasible(std::int64_t guess, std::int64_t longest, Feasible feasible) {
  std::int64_t low = 0;
  std::int64_t high = longest + 1;
  std::int64_t length = std::clamp<std::int64_t>(guess, 1, longest);
  const bool upwards = feasible(length);
  (upwards ? low : high) = length;
  for (std::int64_t stride = 4; upwards ? high > longest && low < longest : low == 0 && high > 1;
       stride *= 2) {
    length = upwards ? std::min(longest, low + stride) : std::max<std::int64_t>(1, high - stride);
    (feasible(length) ? low : high) = length;
  }
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (feasible(middle) ? low : high) = middle;
  }
  return low;
}

/// Calls `visit` with the integers nearest to `position` that are within `bound` of it, three at most.
template <class Visit>
void for_roundings(double position, double bound, Visit visit) {
  const double nearest = std::round(position);
  const double away = position >= nearest ? 1.0 : -1.0;
  for (const double rounded : {nearest, nearest + away, nearest - away}) {
    if (std::abs(rounded - position) <= bound && fits_record_position(rounded)) visit(rounded);
  }
}

bool better(const KnotCandidate& a, const KnotCandidate& b) {
  return a.reach != b.reach ? a.reach > b.reach : a.misfit < b.misfit;
}

bool same_knot(const PvtKnot& a, const PvtKnot& b) {
  return a.sample == b.sample && a.position == b.position && a.velocity == b.velocity;
}

/// Where each knot of a generation has gone when some of them were dropped.
using NewIndices = std::array<std::size_t, Generation::kWidth>;
constexpr std::size_t kGone = Generation::kWidth;

/// The knots of `generation` whose parents are still there. `moved_to` tells where the parents are, and
/// afterwards where the knots of `generation` are.
Generation descendants(const Generation& generation, NewIndices& moved_to) {
  Generation kept;
  kept.longest_allowed = generation.longest_allowed;
  NewIndices own;
  own.fill(kGone);
  for (std::size_t i = 0; i < generation.size(); ++i) {
    KnotCandidate candidate = generation[i];
    if (moved_to[candidate.parent] == kGone) continue;
    candidate.parent = moved_to[candidate.parent];
    own[i] = kept.size();
    kept.add(candidate);
  }
  moved_to = own;
  return kept;
}

}  // namespace

bool Generation::wants(const KnotCandidate& candidate) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (same_knot(candidates_[i].knot, candidate.knot)) return false;
  }
  return size_ < kWidth || better(candidate, candidates_[size_ - 1]);
}

void Generation::add(const KnotCandidate& candidate) {
  if (size_ < kWidth) ++size_;
  std::size_t i = size_ - 1;
  for (; i > 0 && better(candidate, candidates_[i - 1]); --i) candidates_[i] = candidates_[i - 1];
  candidates_[i] = candidate;
}

std::int64_t Generation::shortest() const {
  std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < size_; ++i) shortest = std::min(shortest, candidates_[i].duration);
  return shortest;
}

KnotSearch::KnotSearch(PathSamples samples, const SegmentRules& rules, std::int64_t max_record_ms,
                       const PvtKnot& from)
    : samples_(std::move(samples)), rules_(rules), max_record_(max_record_ms), dead_end_(from) {
  KnotCandidate root;
  root.knot = from;
  generations_[0].add(root);
  for (Generation& generation : generations_) generation.longest_allowed = max_record_;
}

std::int64_t KnotSearch::look_ahead() {
  // kDepth generations, the record after the last of them that the choice looks at, and none beyond the end.
  const std::int64_t ahead = static_cast<std::int64_t>(kDepth + 1) * max_record_;
  const std::int64_t last = std::min(samples_.end(), knot().sample + ahead);
  samples_.move_window(knot().sample, last);
  return last;
}

bool KnotSearch::next(KnotCandidate& decided) {
  dead_end_ = knot();
  int retreats_left = kMaxRetreats;
  while (!reached_end() && depth_ < kDepth) {
    if (!grow() && !retreat(retreats_left)) return false;
  }
  decided = decide();
  return true;
}

bool KnotSearch::reached_end() const { return generations_[depth_][0].knot.sample >= samples_.end(); }

bool KnotSearch::grow() {
  const Generation& parents = generations_[depth_];
  Generation& children = generations_[depth_ + 1];
  children.clear();
  breed(parents, kCaution * rules_.bound, children);
  if (children.empty()) breed(parents, rules_.bound, children);
  if (children.empty()) {
    note_dead_end(parents);
    return false;
  }
  ++depth_;
  return true;
}

/// Makes the next grow() repeat an earlier generation with shorter records. False when there is none left to
/// repeat.
bool KnotSearch::retreat(int& retreats_left) {
  generations_[depth_ + 1].longest_allowed = max_record_;
  while (depth_ > 0 && retreats_left-- > 0) {
    Generation& failed = generations_[depth_--];
    failed.longest_allowed = failed.shortest() * 3 / 4;
    if (failed.longest_allowed > 0) return true;
    failed.longest_allowed = max_record_;
  }
  return false;
}

/// Decides the first knot on the way to the best one known, and keeps the knots that descend from it.
KnotCandidate KnotSearch::decide() {
  std::size_t chosen = 0;
  for (std::size_t d = depth_; d > 1; --d) chosen = generations_[d][chosen].parent;
  const KnotCandidate decided = generations_[1][chosen];
  generations_[0].clear();
  generations_[0].add(decided);
  NewIndices moved_to;
  moved_to.fill(kGone);
  moved_to[chosen] = 0;
  for (std::size_t d = 2; d <= depth_; ++d) generations_[d - 1] = descendants(generations_[d], moved_to);
  generations_[depth_].longest_allowed = max_record_;
  --depth_;
  return decided;
}

void KnotSearch::breed(const Generation& parents, double bound, Generation& children) {
  for (std::size_t i = 0; i < parents.size(); ++i) expand(parents[i], i, bound, children);
}

void KnotSearch::expand(const KnotCandidate& from, std::size_t index, double bound, Generation& children) {
  const SegmentFit fit(samples_, rules_, bound, from.knot);
  const std::int64_t allowed = std::min(children.longest_allowed, samples_.end() - from.knot.sample);
  const std::int64_t longest = longest_segment(fit, from.knot, allowed);
  const auto enough = static_cast<std::int64_t>(std::ceil(kShortestPart * static_cast<double>(longest)));
  const std::int64_t step = std::max<std::int64_t>(1, longest / kStepsPerLength);
  KnotCandidate candidate;
  candidate.parent = index;
  for (candidate.duration = longest; candidate.duration > 0;) {
    offer_length(fit, from, candidate, bound, children);
    candidate.duration -= candidate.duration > enough ? step : 1;
    if (candidate.duration < enough && !children.empty()) break;
  }
}

/// Offers the knots that end candidate.duration after `from`: the nearest positions, each with the velocity
/// nearest to the path's own of those allowed.
void KnotSearch::offer_length(const SegmentFit& fit, const KnotCandidate& from, KnotCandidate candidate,
                              double bound, Generation& children) {
  const std::int64_t duration = candidate.duration;
  candidate.knot.sample = from.knot.sample + duration;
  if (candidate.knot.sample == samples_.end()) {
    const double final_position = std::round(samples_.final_position());
    if (!fits_record_position(final_position)) return;
    candidate.knot.position = static_cast<std::int32_t>(final_position);
    offer(from, candidate, bound, children);
    return;
  }
  const double position = samples_.position(candidate.knot.sample);
  const double velocity = samples_.velocity(candidate.knot.sample);
  for_roundings(position, rules_.bound, [&](double rounded) {
    const auto interval = fit.within_limits(fit.within_bound(duration, rounded), duration, rounded);
    const double lowest = std::ceil(interval.low / rules_.velocity_unit);
    const double highest = std::floor(interval.high / rules_.velocity_unit);
    if (!(lowest <= highest)) return;
    const double chosen = std::clamp(std::round(velocity / rules_.velocity_unit), lowest, highest);
    candidate.knot.position = static_cast<std::int32_t>(rounded);
    candidate.knot.velocity = static_cast<std::int32_t>(chosen);
    candidate.misfit = std::abs(rounded - position) +
                       std::abs(chosen * rules_.velocity_unit - velocity) * static_cast<double>(duration) / 4;
    offer(from, candidate, bound, children);
  });
}

void KnotSearch::offer(const KnotCandidate& from, KnotCandidate candidate, double bound,
                       Generation& children) {
  const SegmentFit onward(samples_, rules_, bound, candidate.knot);
  if (children.full() && !reaches(onward, candidate.knot, children.least_reach())) return;
  candidate.reach = reach_of(onward, candidate.knot);
  if (!children.wants(candidate)) return;
  candidate.figures = execute(samples_, rules_, from.knot, candidate.knot);
  if (candidate.figures.keep(rules_)) children.add(candidate);
}

std::int64_t KnotSearch::longest_segment(const SegmentFit& fit, const PvtKnot& from, std::int64_t longest) {
  const std::int64_t found = longest_feasible(segment_guess_, longest, [&](std::int64_t duration) {
    bool possible = false;
    for_roundings(samples_.position(from.sample + duration), rules_.bound, [&](double rounded) {
      possible = possible || !fit.within_bound(duration, rounded).empty();
    });
    return possible;
  });
  if (found > 0) segment_guess_ = found;
  return found;
}

/// Whether a record from `knot` to the path's own position and velocity at `sample` keeps the bound.
bool KnotSearch::reaches(const SegmentFit& onward, const PvtKnot& knot, std::int64_t sample) const {
  const std::int64_t duration = sample - knot.sample;
  if (knot.sample >= samples_.end() || duration <= 0) return true;
  if (duration > max_record_ || sample > samples_.end()) return false;
  if (sample == samples_.end())
    return onward.keeps_bound(duration, std::round(samples_.final_position()), 0.0);
  return onward.keeps_bound(duration, samples_.position(sample), samples_.velocity(sample));
}

/// The farthest such sample; beyond every sample if `knot` ends the path.
std::int64_t KnotSearch::reach_of(const SegmentFit& onward, const PvtKnot& knot) {
  const std::int64_t left = samples_.end() - knot.sample;
  if (left <= 0) return std::numeric_limits<std::int64_t>::max();
  const std::int64_t found =
      longest_feasible(reach_guess_ - knot.sample, std::min(max_record_, left),
                       [&](std::int64_t duration) { return reaches(onward, knot, knot.sample + duration); });
  reach_guess_ = knot.sample + found;
  return reach_guess_;
}

void KnotSearch::note_dead_end(const Generation& parents) {
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i].knot.sample > dead_end_.sample) dead_end_ = parents[i].knot;
  }
}

}  // namespace interpolated_motion::encoding
