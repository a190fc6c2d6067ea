#include "interpolated_motion_driver/axis/cyclic/way_back.h"

#include <limits>
#include <utility>

#include "interpolated_motion_driver/trajectory/rejoin.h"

namespace interpolated_motion::axis {

namespace {

/// Of the limits, for the way back to the path.
constexpr double kMargin = 1.1;
/// Periods, the way back to the path: fewer are a jerk, and with more the joint is not where it is thought to
/// be.
constexpr int kShortest = 6;
constexpr int kLongest = 50;
/// One that the drive does not make well is followed by one so much longer.
constexpr double kNext = 1.5;
/// Of what the drive's acceleration differs by from that of the path, at the start of the way back. Without a
/// step it is the smoothest; but from an acceleration that is the wrong way no length keeps the limits where
/// the path itself needs most of them.
constexpr double kShares[] = {1.0, 0.5, 0.0};

double acceleration_on(const trajectory::Path& path, GoalTime time) {
  return time >= path.end_time() ? 0.0 : path.sample(time).acceleration;
}

/// Tries ways back of all lengths.
class Search {
 public:
  Search(const trajectory::Path& path, const trajectory::JointLimits& limits,
         const encoding::SetpointEncoding& encoding)
      : path_(path), limits_(limits), encoding_(encoding) {}

  /// Whether one of them is good; else the gentlest is kept.
  bool finds_from(const Departure& from) {
    const GoalTime longest = kLongest * encoding_.period;
    GoalTime length = kShortest * encoding_.period;
    while (auto way = trajectory::rejoin(path_, from.state, from.start, limits_, kMargin, length, longest)) {
      length = kNext * way->pieces().front().duration();
      if (takes(from, std::move(*way))) return true;
    }
    return false;
  }

  /// Nothing where none keeps the limits.
  std::optional<trajectory::Path> best() const {
    if (best_.empty()) return std::nullopt;
    return best_;
  }

 private:
  bool takes(const Departure& from, trajectory::Path way) {
    const GoalTime until = way.pieces().front().end + interpolation::kCipHistory * encoding_.period;
    const double acceleration = demand_acceleration(from, way, until, encoding_);
    if (acceleration < least_) {
      least_ = acceleration;
      best_ = std::move(way);
    }
    return acceleration <= encoding_.max_acceleration;
  }

  const trajectory::Path& path_;
  const trajectory::JointLimits& limits_;
  const encoding::SetpointEncoding& encoding_;
  trajectory::Path best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double demand_acceleration(const Departure& from, const trajectory::Path& way_on, GoalTime until,
                           const encoding::SetpointEncoding& encoding) {
  return encoding::demand_acceleration(from.known, from.next, until, way_on, encoding);
}

std::optional<trajectory::Path> way_back(const trajectory::Path& path, const Departure& from,
                                         const trajectory::JointLimits& limits,
                                         const encoding::SetpointEncoding& encoding) {
  const double on_path = acceleration_on(path, from.start);
  Search search(path, limits, encoding);
  for (const double share : kShares) {
    Departure start = from;
    start.state.acceleration = on_path + share * (from.state.acceleration - on_path);
    if (search.finds_from(start)) break;
  }
  return search.best();
}

}  // namespace interpolated_motion::axis
