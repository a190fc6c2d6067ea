#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What a SilverLode drive is to play, before any of it has been sent.
struct ImsPlan {
  trajectory::Path path;           ///< rad or m over goal time
  std::vector<RecordSlot> slots;   ///< goal time, as Axis::record_slots() gives them
  std::optional<HostTime> origin;  ///< host time of goal time 0, for a stream
  encoding::ImsEncoding encoding;  ///< with which the path has been found possible
  double lead = 0.0;               ///< s, from arm() to the begin of the path, as of load()
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

/// The plan of a goal: `path` from `rest_counts`, where the demand rests. It is encoded whole to see that it
/// can be done and what the line has to carry.
Expected<ImsPlan, Refusal> plan_ims_goal(const SilverlodeAxisParameters& parameters,
                                         const SegmentDelivery& delivery, const silverlode::LineMaster& line,
                                         const trajectory::Path& path, std::int32_t rest_counts);

/// The records of segments that begin at `begins`, s, to be sent to a drive in motion that has the first
/// `sent` of them already; `start`: goal time of 0 s.
std::vector<RecordSlot> ims_slots_in_motion(const SilverlodeAxisParameters& parameters,
                                            const SegmentDelivery& delivery,
                                            const std::vector<double>& begins, std::size_t sent,
                                            GoalTime start);

/// How far ahead of the present a stream is committed, at most.
GoalTime ims_stream_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                         const silverlode::LineMaster& line);

}  // namespace interpolated_motion::axis
