#pragma once

#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/axis/epos/epos_device.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What an EPOS drive is to play, encoded, before any of it has been sent.
struct PvtPlan {
  RecordFeed feed;                 ///< all records of the plan, none of them sent
  GoalTime start{0.0};             ///< goal time of the path's start
  GoalTime wait{0.0};              ///< from the start signal until then
  std::optional<HostTime> origin;  ///< host time of goal time 0, for a stream
};

/// The plan of a goal: `path` from `rest_counts`, where the demand rests, after `wait` of rest.
Expected<PvtPlan, Refusal> plan_pvt_goal(const EposDevice& drive, const trajectory::Path& path, GoalTime wait,
                                         std::int32_t rest_counts);

/// The begin of a stream, whose goal time 0 is at `origin`: `rest` at `rest_counts`.
Expected<PvtPlan, Refusal> plan_pvt_standing(const EposDevice& drive, HostTime origin, GoalTime rest,
                                             std::int32_t rest_counts);

/// What comes behind the records that have been sent, when the path has changed.
struct PvtWayOn {
  encoding::PvtStream stream;  ///< from the knot where those lead
  FeedLimits limits;           ///< with which it is fed
  double rate = 1.0;           ///< goal seconds per second of the drive's clock
};

/// The way on along `rest`, from `knot` on, at rate 1. With the bound of a goal, doubled as often as it takes
/// up to `stream_deviation_bound`: the knot was chosen for another way on.
Expected<PvtWayOn, Refusal> plan_pvt_way_on(const EposDevice& drive, const trajectory::Path& rest,
                                            const encoding::PvtKnot& knot, Pace pace);

/// How far ahead of the present a stream is committed, at most.
GoalTime pvt_stream_lead(const EposDevice& drive);

}  // namespace interpolated_motion::axis
