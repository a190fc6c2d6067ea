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

}  // namespace

double demand_acceleration(const Departure& from, const trajectory::Path& way_on, GoalTime until,
                           const encoding::SetpointEncoding& encoding) {
  return encoding::demand_acceleration(from.known, from.next, until, way_on, encoding);
}

std::optional<trajectory::Path> way_back(const trajectory::Path& path, const Departure& from,
                                         const trajectory::JointLimits& limits,
                                         const encoding::SetpointEncoding& encoding) {
  const GoalTime longest = kLongest * encoding.period;
  GoalTime length = kShortest * encoding.period;
  std::optional<trajectory::Path> gentlest;
  double least = std::numeric_limits<double>::infinity();
  while (auto way = trajectory::rejoin(path, from.state, from.start, limits, kMargin, length, longest)) {
    const GoalTime end = way->pieces().front().end;
    const GoalTime until = end + static_cast<double>(interpolation::kCipHistory) * encoding.period;
    const double acceleration = demand_acceleration(from, *way, until, encoding);
    if (acceleration <= encoding.max_acceleration) return way;
    if (acceleration < least) {
      least = acceleration;
      gentlest = std::move(way);
    }
    length = kNext * (end - from.start);
  }
  return gentlest;
}

}  // namespace interpolated_motion::axis
