#include "interpolated_motion_driver/encoding/ims/ims_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace interpolated_motion::encoding {

namespace {

using interpolation::ImsState;

/// Part of the bound that quick tests may use up: between their ticks the deviation is a few per cent
/// greater.
constexpr double kCaution = 0.97;

/// Shortest segments offered, as a part of the longest possible.
constexpr double kShortestPart = 0.5;

/// Gates of the funnel tried, at most, and accelerations within each: parts of the way from low to high.
constexpr std::size_t kGatesTried = 9;
constexpr double kParts[] = {0.0, 0.25, 0.5, 0.75, 1.0};

/// Retreats before a path is given up. Each shortens one segment by a quarter, so a dead end left at all is
/// left early.
constexpr int kMaxRetreats = 256;

/// Reach of a knot from which there is nothing more to do, and of one that only has to land.
constexpr double kDone = 2e18;
constexpr double kLands = 1e18;

bool better(const ImsCandidate& a, const ImsCandidate& b) {
  return a.reach != b.reach ? a.reach > b.reach : a.misfit < b.misfit;
}

/// Where each knot of a generation has gone when some of them were dropped.
using NewIndices = std::array<std::size_t, ImsGeneration::kWidth>;
constexpr std::size_t kGone = ImsGeneration::kWidth;

/// Keeps the knots of `generation` whose parents are still there. `moved_to` tells where the parents are, and
/// afterwards where the knots of `generation` are.
void keep_descendants(const ImsGeneration& generation, NewIndices& moved_to, ImsGeneration& kept) {
  NewIndices own;
  own.fill(kGone);
  const std::size_t size = generation.size;  // `kept` may be a generation that shifts by one
  kept.size = 0;
  kept.longest_allowed = generation.longest_allowed;
  for (std::size_t i = 0; i < size; ++i) {
    ImsCandidate candidate = generation.candidates[i];
    if (moved_to[candidate.parent] == kGone) continue;
    candidate.parent = moved_to[candidate.parent];
    own[i] = kept.size;
    kept.add(candidate);
  }
  moved_to = own;
}

}  // namespace

bool ImsGeneration::holds(const ImsCandidate& candidate) const {
  return std::any_of(
      candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(size),
      [&](const ImsCandidate& c) { return c.tick == candidate.tick && c.state == candidate.state; });
}

std::int64_t ImsGeneration::shortest() const {
  std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < size; ++i) shortest = std::min(shortest, candidates[i].move.ticks);
  return shortest;
}

std::int64_t ImsSearch::window(const ImsRules& rules) {
  // kDepth generations, the segment after the last of them that the choice looks at, and its landing.
  return static_cast<std::int64_t>(kDepth + 3) * rules.max_ticks;
}

ImsSearch::ImsSearch(TickSamples samples, const ImsRules& rules, std::int64_t target,
                     const ImsCandidate& from)
    : samples_(std::move(samples)),
      rules_(rules),
      target_(target),
      target_sum_(interpolation::ims_at_rest(rules.scale, target).sum),
      seconds_per_tick_(rules.scale.tick),
      dead_end_(from) {
  generations_[0].add(from);
  forget_generations();
}

void ImsSearch::forget_generations() {
  depth_ = 0;
  for (ImsGeneration& generation : generations_) generation.longest_allowed = rules_.max_ticks;
}

void ImsSearch::restart(double seconds_per_tick) {
  if (!restarted_) known_ = {generations_, depth_, seconds_per_tick_};
  restarted_ = true;
  seconds_per_tick_ = seconds_per_tick;
  samples_.restart(knot().tick, samples_.goal_time(knot().tick), seconds_per_tick);
  forget_generations();
}

bool ImsSearch::take_back_restart() {
  if (!restarted_) return false;
  restarted_ = false;
  seconds_per_tick_ = known_.seconds_per_tick;
  samples_.restart(knot().tick, samples_.goal_time(knot().tick), seconds_per_tick_);
  generations_ = known_.generations;
  depth_ = known_.depth;
  return true;
}

bool ImsSearch::next(ImsCandidate& decided) {
  samples_.forget_before(knot().tick);
  dead_end_ = knot();
  int retreats_left = kMaxRetreats;
  while (!arrived() && depth_ < kDepth) {
    if (!grow() && !retreat(retreats_left)) return false;
  }
  decided = decide();
  return true;
}

bool ImsSearch::finished(const ImsCandidate& candidate) const {
  return at_rest_on_target(candidate.state) && candidate.tick >= samples_.end();
}

bool ImsSearch::at_rest_on_target(const ImsState& state) const {
  return state.velocity == 0 && state.sum == target_sum_;
}

bool ImsSearch::grow() {
  const ImsGeneration& parents = generations_[depth_];
  ImsGeneration& children = generations_[depth_ + 1];
  if (breed(parents, kCaution * rules_.bound, children) || breed(parents, rules_.bound, children)) {
    ++depth_;
    return true;
  }
  note_dead_end(parents);
  return false;
}

bool ImsSearch::breed(const ImsGeneration& parents, double bound, ImsGeneration& children) {
  offered_ = 0;
  for (std::size_t i = 0; i < parents.size; ++i) {
    expand(parents.candidates[i], i, bound, children.longest_allowed);
  }
  choose(parents, children);
  return children.size > 0;
}

/// Makes the next grow() repeat an earlier generation with shorter segments. False when there is none left to
/// repeat.
bool ImsSearch::retreat(int& retreats_left) {
  generations_[depth_ + 1].longest_allowed = rules_.max_ticks;
  while (depth_ > 0 && retreats_left-- > 0) {
    ImsGeneration& failed = generations_[depth_--];
    failed.longest_allowed = failed.shortest() * 3 / 4;
    if (failed.longest_allowed >= rules_.min_ticks) return true;
    failed.longest_allowed = rules_.max_ticks;
  }
  return false;
}

/// Decides the first knot on the way to the best one known, and keeps the knots that descend from it.
ImsCandidate ImsSearch::decide() {
  std::size_t chosen = 0;
  for (std::size_t d = depth_; d > 1; --d) chosen = generations_[d].candidates[chosen].parent;
  const ImsCandidate decided = generations_[1].candidates[chosen];
  generations_[0].size = 0;
  generations_[0].add(decided);
  NewIndices moved_to;
  moved_to.fill(kGone);
  moved_to[chosen] = 0;
  for (std::size_t d = 2; d <= depth_; ++d) keep_descendants(generations_[d], moved_to, generations_[d - 1]);
  generations_[depth_].longest_allowed = rules_.max_ticks;
  --depth_;
  restarted_ = false;
  return decided;
}

void ImsSearch::expand(const ImsCandidate& from, std::size_t index, double bound, std::int64_t longest) {
  if (offer_rest(from, index, bound)) return;
  offer_landing(from, index, bound);
  offer_settling(from, index, bound);
  offer_ramps(from, index, bound, longest);
}

/// The segment that waits for the end of the path on its final position.
bool ImsSearch::offer_rest(const ImsCandidate& from, std::size_t index, double bound) {
  const std::int64_t left = samples_.end() - from.tick;
  if (!at_rest_on_target(from.state) || left > rules_.max_ticks) return false;
  const std::int64_t ticks = std::max(left, rules_.min_ticks);
  for (std::int64_t part = 1; part <= 32; ++part) {
    if (!(std::abs(path_at(from.tick + ticks * part / 32) - static_cast<double>(target_)) <= bound))
      return false;
  }
  ImsCandidate candidate;
  candidate.tick = from.tick + ticks;
  candidate.state = from.state;
  candidate.move.ticks = ticks;
  candidate.parent = index;
  offer(candidate, bound);
  return true;
}

void ImsSearch::offer_landing(const ImsCandidate& from, std::size_t index, double bound) {
  ImsCandidate candidate;
  if (!may_land(from.state, from.tick, bound, candidate.move)) return;
  candidate.tick = from.tick + candidate.move.ticks;
  candidate.state = {target_sum_, 0};
  candidate.parent = index;
  offer(candidate, bound);
}

/// The segment that corrects a rest next to the final position when the path has come to its end.
void ImsSearch::offer_settling(const ImsCandidate& from, std::size_t index, double bound) {
  ImsCandidate candidate;
  if (!may_settle(from.state, from.tick, bound, candidate.move)) return;
  candidate.tick = from.tick + candidate.move.ticks;
  candidate.state = {target_sum_, 0};
  candidate.parent = index;
  offer(candidate, bound);
}

/// Ramps to the last gates of the funnel, and accelerations spread over each gate.
void ImsSearch::offer_ramps(const ImsCandidate& from, std::size_t index, double bound, std::int64_t longest) {
  const std::int64_t look = std::min(longest, ticks_to_look(from.tick));
  funnel_.open(rules_, samples_, bound, from.tick, from.state, look);
  const double shortest = std::max(kShortestPart * funnel_.reach(), static_cast<double>(rules_.min_ticks));
  std::size_t first = funnel_.size();
  while (first > 0 && static_cast<double>(funnel_[first - 1].ticks) >= shortest) --first;
  const std::size_t gates = funnel_.size() - first;
  const std::size_t skip = gates / (kGatesTried + 1) + 1;
  for (std::size_t i = 0; i < gates; i += skip) {
    const AccelerationFunnel::Gate gate = funnel_[funnel_.size() - 1 - i];
    for (const double part : kParts) {
      offer_ramp(from, index, bound, gate.ticks, gate.low + part * (gate.high - gate.low));
    }
    if (gate.low < 0 && gate.high > 0) offer_ramp(from, index, bound, gate.ticks, 0.0);
  }
}

void ImsSearch::offer_ramp(const ImsCandidate& from, std::size_t index, double bound, std::int64_t ticks,
                           double acceleration) {
  ImsCandidate candidate;
  candidate.move = plan_ramp(rules_, from.state, ticks, acceleration);
  if (std::abs(candidate.move.velocity) > rules_.max_velocity || candidate.move.step > rules_.max_step)
    return;
  candidate.tick = from.tick + ticks;
  candidate.state =
      interpolation::ramp_and_hold(from.state, candidate.move.velocity, candidate.move.step, ticks);
  candidate.parent = index;
  offer(candidate, bound);
}

void ImsSearch::offer(const ImsCandidate& candidate, double bound) {
  if (offered_ == kMaxOffers) return;
  ImsCandidate& kept = offers_[offered_];
  kept = candidate;
  if (finished(candidate)) {
    kept.reach = kDone;
  } else if (may_end(candidate, bound)) {
    kept.reach = kLands;
  } else {
    onward_.open(rules_, samples_, bound, candidate.tick, candidate.state, ticks_to_look(candidate.tick));
    if (onward_.reach() < static_cast<double>(rules_.min_ticks)) return;
    kept.reach = static_cast<double>(candidate.tick) + onward_.reach();
  }
  const double position = interpolation::ims_counts(rules_.scale, candidate.state);
  const bool holds = candidate.move.step == 0;  // preferred to a ramp that reaches no farther
  kept.misfit = holds ? 0.0 : std::abs(position - path_at(candidate.tick));
  ++offered_;
}

/// Whether one more segment is enough: a landing, or, for a drive that has been brought to rest after the
/// path's end, a settling. Without the latter one that creeps on within the bound would seem as good.
bool ImsSearch::may_end(const ImsCandidate& candidate, double bound) {
  ImsMove last;
  if (may_land(candidate.state, candidate.tick, bound, last))
    return candidate.tick + last.ticks >= samples_.end();
  return candidate.tick >= samples_.end() && may_settle(candidate.state, candidate.tick, bound, last);
}

/// Whether the drive rests so near to the final position that one move leads there, by the path's position.
bool ImsSearch::may_settle(const ImsState& state, std::int64_t tick, double bound, ImsMove& move) {
  const double target = static_cast<double>(target_);
  const double off = interpolation::ims_counts(rules_.scale, state) - target;
  if (state.velocity != 0 || state.sum == target_sum_ || !(std::abs(off) <= 2 * rules_.bound)) return false;
  if (!(std::abs(path_at(tick) - target) <= bound)) return false;
  move = plan_settling(rules_, samples_.end() - tick, state, target_);
  return true;
}

/// Whether the drive can brake onto the final position from here, by a few ticks of the path.
bool ImsSearch::may_land(const ImsState& state, std::int64_t tick, double bound, ImsMove& move) {
  if (!plan_landing(rules_, samples_.end() - tick, state, target_, move)) return false;
  const double start = interpolation::ims_counts(rules_.scale, state);
  const double way = static_cast<double>(target_) - start;
  const std::int64_t braking = std::abs(state.velocity) / move.step + 1;
  for (const std::int64_t quarter : {4, 2, 3, 1}) {
    const double left = 1.0 - 0.25 * static_cast<double>(quarter);
    const double position = start + way * (1.0 - left * left);
    if (!(std::abs(path_at(tick + braking * quarter / 4) - position) <= bound)) return false;
  }
  return std::abs(path_at(tick + move.ticks) - static_cast<double>(target_)) <= bound;
}

/// How far a segment may go: until the path rests for good, and then some time to land.
std::int64_t ImsSearch::ticks_to_look(std::int64_t tick) const {
  const std::int64_t after_end = std::max<std::int64_t>(4 * rules_.min_ticks, 128);
  return std::min(rules_.max_ticks, std::max(samples_.end() - tick, after_end));
}

/// Executes the offers, best first, until there are enough that keep their rules.
void ImsSearch::choose(const ImsGeneration& parents, ImsGeneration& children) {
  children.size = 0;
  const auto begin = offers_.begin();
  auto end = begin + static_cast<std::ptrdiff_t>(offered_);
  const auto worse = [](const ImsCandidate& a, const ImsCandidate& b) { return better(b, a); };
  while (begin != end && !children.full()) {
    std::iter_swap(std::max_element(begin, end, worse), end - 1);
    ImsCandidate& candidate = *--end;
    if (children.holds(candidate)) continue;
    const ImsCandidate& parent = parents.candidates[candidate.parent];
    ImsState reached;
    samples_.extend_to(candidate.tick);
    const bool executed =
        execute(rules_, samples_, parent.tick, parent.state, candidate.move, reached, candidate.figures);
    if (executed && reached == candidate.state && candidate.figures.keep(rules_)) children.add(candidate);
  }
}

double ImsSearch::path_at(std::int64_t tick) {
  samples_.extend_to(tick);
  return *samples_.counts_from(tick);
}

void ImsSearch::note_dead_end(const ImsGeneration& parents) {
  for (std::size_t i = 0; i < parents.size; ++i) {
    if (parents.candidates[i].tick > dead_end_.tick) dead_end_ = parents.candidates[i];
  }
}

}  // namespace interpolated_motion::encoding
