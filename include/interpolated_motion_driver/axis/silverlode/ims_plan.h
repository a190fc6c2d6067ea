#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// From rest.
struct ImsPlan : Tail {
  trajectory::Path path;           ///< rad or m over goal time
  std::optional<HostTime> origin;  ///< host time of goal time 0, for a stream
  encoding::ImsEncoding encoding;  ///< with which the path has been found possible
};

/// Behind the segments that have been encoded for a drive.
struct ImsWayOn : Tail {
  GoalTime from{0.0};                           ///< of the feed's knot
  std::unique_ptr<SegmentFeed::Source> source;  ///< in the feed's own goal time
  double widest = 0.0;                          ///< counts, up to where its bound may be doubled
};

/// Segments of each drive of a line that the lead has time for.
inline constexpr std::size_t kSegmentsOfLead = 4;

/// From arm() to the begin of the path, s: `start_lead`, and more on a line whose drives answer later than
/// `turnaround`.
double ims_start_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                      const silverlode::LineMaster& line);

/// Time before the begin of the path in which its first segments can cross the line, s: what is left of the
/// lead, as late as the begin may be told, when all drives of the line have got their start command and their
/// second segment of waiting.
double ims_filling_time(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                        const silverlode::LineMaster& line);

/// Share of the lead that may be gone when the axis is told the begin.
inline constexpr double kLatestTold = 0.3;

/// How segments of goals, and of streams, are encoded. A segment is committed as a whole, so those of streams
/// are kept short: as short as the line can follow, and twice as long at most.
encoding::ImsEncoding ims_goal_encoding(const SilverlodeAxisParameters& parameters,
                                        const SegmentDelivery& delivery, const silverlode::LineMaster& line);
encoding::ImsEncoding ims_stream_encoding(const SilverlodeAxisParameters& parameters,
                                          const SegmentDelivery& delivery,
                                          const silverlode::LineMaster& line);

/// Of goals from `rest_counts`, where the demand rests. They are encoded whole to see that they can be done
/// and what the line has to carry.
TailEncoderPtr ims_goal_encoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                                const silverlode::LineMaster& line, std::int32_t rest_counts);

/// Of ways on behind the knot of `feed`, whose goal time begins at goal time `begin`. Encoded to their end:
/// what the drive is given always leads to rest.
TailEncoderPtr ims_way_on_encoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                                  const silverlode::LineMaster& line, const SegmentFeed& feed, GoalTime begin,
                                  Pace pace);

/// s of motion wanted in the drive.
double ims_horizon(const SilverlodeAxisParameters& parameters, Pace pace);

/// How far ahead of the present a stream is committed, at most.
GoalTime ims_stream_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                         const silverlode::LineMaster& line);

}  // namespace interpolated_motion::axis
