#pragma once

#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/axis/epos/epos_device.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// From rest.
struct PvtPlan : Tail {
  RecordFeed feed;                 ///< all records of the plan, none of them sent
  GoalTime start{0.0};             ///< goal time of the path's start
  GoalTime wait{0.0};              ///< from the start signal until then
  std::optional<HostTime> origin;  ///< host time of goal time 0, for a stream
};

/// Behind the records that a drive is committed to.
struct PvtWayOn : Tail {
  encoding::PvtKnot from;      ///< where those lead
  encoding::PvtStream stream;  ///< from there, at `rate`
  FeedLimits limits;           ///< with which it is fed
  double rate = 1.0;           ///< goal seconds per second of the drive's clock
};

/// Where a way on joins.
struct PvtJoin {
  encoding::PvtKnot knot;  ///< as RecordFeed::committed_knot() gives it
  GoalTime reached{0.0};   ///< goal time there
  double rate = 1.0;       ///< goal seconds per second of the drive's clock from there on
  RecordFeed before;       ///< what the drive is committed to
};

/// Of goals from `rest_counts`, where the demand rests, after `wait` of rest.
TailEncoderPtr pvt_goal_encoder(const EposDevice& drive, GoalTime wait, std::int32_t rest_counts);

/// The begin of a stream, whose goal time 0 is at `origin`: `rest` at `rest_counts`.
Expected<TailPtr, Refusal> plan_pvt_standing(const EposDevice& drive, HostTime origin, GoalTime rest,
                                             std::int32_t rest_counts);

/// Of ways on. With the bound of a goal, doubled as often as it takes up to `stream_deviation_bound`: the
/// knot was chosen for another way on.
TailEncoderPtr pvt_way_on_encoder(const EposDevice& drive, Pace pace, PvtJoin join);

/// How far ahead of the present a stream is committed, at most.
GoalTime pvt_stream_lead(const EposDevice& drive);

}  // namespace interpolated_motion::axis
