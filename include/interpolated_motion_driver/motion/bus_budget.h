#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// The records one axis will send over a bus, how long each keeps the bus, and what else it asks of it.
struct BusDemand {
  std::vector<axis::RecordSlot> slots;  ///< in goal time, the same zero for all axes
  double record_bus_time = 0.0;         ///< s, as share of what records may fill
  axis::BusWatch watch{};               ///< besides
};

/// A record that would come too late.
struct MissedDeadline {
  GoalTime time{0.0};   ///< when the drive needs the record
  GoalTime late{0.0};   ///< by so much it would come too late
  double needed = 0.0;  ///< records per second asked for in the second before
  double looks = 0.0;   ///< share of the bus that questions take; 0: the share for records is too small
};

/// Checks that one bus can carry the records of all its axes in time, in the order the axes really send them:
/// whenever the bus is free, of those that may be sent the one with the earliest deadline. Records that fit
/// into the FIFOs are loaded before the start and cost nothing; the others are sent not before the FIFO has a
/// place for them.
///
/// Twice: within the share of the bus that records may fill; and where axes ask questions over it
/// (axis::BusWatch), with all of the bus and all that it carries. Questions that are due go before records,
/// those of the axes one after the other, and one has just begun whenever a record finds the bus without
/// work.
std::optional<MissedDeadline> check_bus_budget(const std::vector<BusDemand>& demands, GoalTime start);

}  // namespace interpolated_motion::motion
