#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The records one axis will send over a bus, and how long each keeps the bus.
struct BusDemand {
  std::vector<axis::RecordSlot> slots;
  double record_bus_time = 0.0;  ///< s
};

/// A record that would come too late.
struct MissedDeadline {
  GoalTime time{0.0};   ///< when the drive needs the record
  double needed = 0.0;  ///< records per second asked for in the second before
};

/// Checks that one bus can carry the records of all its axes in time. Records that fit into the FIFOs are
/// loaded before the start and cost nothing; the others are sent in the order of their deadlines, each not
/// before the FIFO has a place for it. Earliest deadline first is optimal on one bus, so what fails here
/// cannot be carried in any order.
std::optional<MissedDeadline> check_bus_budget(const std::vector<BusDemand>& demands, GoalTime start);

}  // namespace interpolated_motion::motion
