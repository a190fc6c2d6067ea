#include "interpolated_motion_driver/axis/silverlode/ims_approach.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace interpolated_motion::axis {

namespace {

/// s of path within which it shows whether a knot is too far off for a bound.
constexpr GoalTime kShows{1.0};
/// Segments until a closer bound is tried again, and how often that is done.
constexpr int kStep = 2;
constexpr int kTrials = 16;
constexpr int kAll = std::numeric_limits<int>::max();
constexpr GoalTime kEnd{std::numeric_limits<double>::infinity()};

class Way {
 public:
  Way(const trajectory::Path& path, const encoding::ImsEncoding& encoding, const encoding::ImsKnot& from)
      : path_(path), encoding_(encoding), knot_(from) {}

  const encoding::ImsKnot& knot() const { return knot_; }
  bool at_end() const { return at_end_; }
  const std::vector<std::int64_t>& ticks() const { return ticks_; }

  /// Whether segments with this bound lead from the knot to `until`.
  std::optional<Refusal> try_out(double bound, GoalTime until) {
    Way copy(path_, encoding_, knot_);
    return copy.go_on(bound, until, kAll);
  }

  std::optional<Refusal> go_on(double bound, GoalTime until, int segments) {
    encoding_.bound_counts = bound;
    encoding::ImsEncoder encoder(path_, encoding_, knot_);
    ImsSegment segment;
    encoding::ImsCertificate certificate;
    for (int i = 0; i < segments && !encoder.finished() && encoder.knot().goal_time < until; ++i) {
      const auto more = encoder.next(segment, certificate);
      if (!more) return more.error();
      ticks_.push_back(segment.time);
    }
    knot_ = encoder.knot();
    at_end_ = encoder.finished();
    return std::nullopt;
  }

  /// To the end, with a bound doubled as often as it takes.
  std::optional<Refusal> finish(double& bound, double widest) {
    const auto begun = ticks_;
    std::optional<Refusal> refusal = go_on(bound, kEnd, kAll);
    while (refusal && 2.0 * bound <= widest) {
      bound *= 2.0;
      ticks_ = begun;
      refusal = go_on(bound, kEnd, kAll);
    }
    return refusal;
  }

 private:
  const trajectory::Path& path_;
  encoding::ImsEncoding encoding_;
  encoding::ImsKnot knot_;
  std::vector<std::int64_t> ticks_;
  bool at_end_ = false;
};

}  // namespace

Expected<ImsApproach, Refusal> plan_ims_way_on(const trajectory::Path& path,
                                               const encoding::ImsEncoding& encoding,
                                               const encoding::ImsKnot& from, double first, double widest) {
  ImsApproach approach;
  approach.bound = std::max(encoding.bound_counts, first);
  Way way(path, encoding, from);
  if (auto refusal = way.finish(approach.bound, widest)) return *refusal;
  approach.ticks = way.ticks();
  return approach;
}

Expected<ImsApproach, Refusal> plan_ims_approach(const trajectory::Path& path,
                                                 const encoding::ImsEncoding& encoding,
                                                 const encoding::ImsKnot& from, double first, double widest) {
  const double closest = encoding.bound_counts;
  ImsApproach approach;
  double bound = std::max(closest, first);
  Way way(path, encoding, from);
  while (way.try_out(bound, from.goal_time + kShows) && 2.0 * bound <= widest) bound *= 2.0;
  approach.bound = bound;
  for (int trial = 0; trial < kTrials && bound > closest && !way.at_end(); ++trial) {
    if (auto refusal = way.go_on(bound, kEnd, kStep)) return *refusal;
    const double closer = std::max(bound / 2.0, closest);
    if (way.try_out(closer, way.knot().goal_time + kShows)) continue;
    bound = closer;
    approach.bounds.push_back({way.knot().goal_time, bound});
  }
  const double before = bound;
  const GoalTime begin = way.knot().goal_time;
  if (auto refusal = way.finish(bound, widest)) return *refusal;
  if (bound > before) approach.bounds.push_back({begin, bound});
  approach.ticks = way.ticks();
  return approach;
}

}  // namespace interpolated_motion::axis
