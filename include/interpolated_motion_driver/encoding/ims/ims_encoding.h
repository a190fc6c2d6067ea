#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/ims_profile.h"
#include "interpolated_motion_driver/interpolation/ims_segment.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

inline constexpr std::int32_t kMaxImsAcceleration = 1
                                                    << 30;  ///< "approximately 1/2 of this scale" (QCI-TD044)
inline constexpr std::int32_t kMaxImsVelocity = 2147483647;  ///< 2^31 - 1
inline constexpr std::int64_t kMaxImsSegmentTicks =
    1 << 16;                                             ///< of this encoder; a segment's time takes 2^31 - 1
inline constexpr std::int32_t kImsProjection = 1 << 30;  ///< counts, projects the direction of a segment

/// Everything that decides how one joint's path becomes IMS segments.
struct ImsEncoding {
  std::string joint;              ///< for messages
  Transmission transmission;      ///< between joint units and counts
  interpolation::ImsScale scale;  ///< its counts per revolution are those of `transmission`, whatever it says
  double bound_counts = 2.0;      ///< worst allowed deviation from the path at any servo tick, counts
  double max_motor_rpm = 0.0;     ///< of the segments, as executed
  double max_motor_acceleration = 0.0;    ///< rpm/s, of the segments, as executed
  std::int64_t max_segment_ticks = 8192;  ///< longest segment, up to 65536: what is in the drive is committed
  std::int64_t min_segment_ticks = 25;    ///< shortest segment, >= 1: the line must be able to follow

  /// `scale` with the counts per revolution of the transmission.
  interpolation::ImsScale law() const;

  /// Throws std::invalid_argument with joint, parameter, value and allowed range. Infinite limits are
  /// allowed. To be called when the configuration is read; the encoder calls it again.
  void validate() const;
};

/// A knot of the drive's motion.
struct ImsKnot {
  std::int64_t tick = 0;          ///< servo ticks since the interpolated motion began
  GoalTime goal_time{0.0};        ///< where the path is at that tick
  interpolation::ImsState state;  ///< the drive's own integers
};

/// What executing one segment gives, computed before it is sent.
struct ImsCertificate {
  double worst_deviation_counts = 0.0;  ///< at any of the segment's servo ticks, against the path
  double peak_rpm = 0.0;                ///< absolute
  double peak_acceleration = 0.0;       ///< rpm/s, absolute
};

/// A whole path as IMS segments. The first one starts at `start_counts` at rest.
struct ImsStream {
  std::int32_t start_counts = 0;             ///< where the drive stands when the first segment begins
  std::vector<ImsSegment> segments;          ///< without the terminating one (time = 0)
  ImsSegment terminator;                     ///< time 0: ends the interpolated motion after the last segment
  std::vector<ImsCertificate> certificates;  ///< one per segment
  ServoTicks duration{0};                    ///< sum of the segments' times; in ticks of the encoding's scale

  /// Of all certificates, counts; 0 without segments.
  double worst_deviation_counts() const;
};

}  // namespace interpolated_motion::encoding
