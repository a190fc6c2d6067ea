#include "interpolated_motion_driver/motion/bus_demands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/motion/bus_budget.h"

namespace interpolated_motion::motion {

namespace {

using Demands = std::map<std::string, std::vector<BusDemand>>;

/// What is due at the present counts as due just after it: nothing of it has been loaded.
constexpr GoalTime kSoon{1e-9};

/// What a bus can carry: as far as its share for records goes, or beside the questions to its drives.
std::string capacity_text(const MissedDeadline& missed, const BusDemand& demand) {
  if (missed.looks == 0.0)
    return fmt::format("its share for records allows {:.0f} a second", 1.0 / demand.record_bus_time);
  return fmt::format(
      "beside the questions to its drives, which take {:.0f} % of it, it carries {:.0f} a second",
      1e2 * missed.looks, std::max(0.0, 1.0 - missed.looks) / demand.watch.record_time);
}

std::optional<Refusal> refuse(const Demands& demands, GoalTime start) {
  for (const auto& [bus, demand] : demands) {
    const auto missed = check_bus_budget(demand, start);
    if (!missed) continue;
    return Refusal{
        GoalError::InvalidGoal,
        fmt::format(
            "Bus {} cannot carry the goal: at {:.3f} s a record would come {:.0f} ms too late; it needs "
            "{:.0f} records in the second before, and {}. Slow the goal down, use smoother points, raise the "
            "bit rate, or put the drives on more buses.",
            bus, missed->time.count(), std::ceil(1e3 * missed->late.count()), missed->needed,
            capacity_text(*missed, demand.front()))};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> refuse_beyond_buses(const Planning& planning, GoalTime start) {
  Demands demands;
  for (std::size_t i = 0; i < planning.axes.size(); ++i) {
    const Planning::AxisPart& axis = planning.axes[i];
    demands[axis.bus].push_back({planning.tails[i]->slots, axis.record_bus_time, axis.watch});
  }
  return refuse(demands, start);
}

std::optional<Refusal> refuse_way_on_beyond_buses(const Planning& planning, GoalTime now) {
  Demands demands;
  for (std::size_t i = 0; i < planning.axes.size(); ++i) {
    const Planning::AxisPart& axis = planning.axes[i];
    BusDemand demand{planning.tails[i]->slots, axis.record_bus_time, axis.watch};
    demand.watch.lead = GoalTime{0.0};
    for (axis::RecordSlot& slot : demand.slots) slot.release = std::max(slot.release, now + kSoon);
    demands[axis.bus].push_back(std::move(demand));
  }
  return refuse(demands, now);
}

}  // namespace interpolated_motion::motion
