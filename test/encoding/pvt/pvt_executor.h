#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::encoding::testing {

/// A segment in Hermite basis functions of u = t / T and in extended precision: shares nothing with the code
/// under test.
struct BasisSegment {
  long double p0, v0, p1, v1, t;  ///< counts, counts/ms, ms

  long double position(long double u) const {
    return (1 + 2 * u) * (1 - u) * (1 - u) * p0 + u * (1 - u) * (1 - u) * t * v0 + u * u * (3 - 2 * u) * p1 +
           u * u * (u - 1) * t * v1;
  }
  long double velocity(long double u) const {
    return 6 * u * (1 - u) * (p1 - p0) / t + (1 - u) * (1 - 3 * u) * v0 + u * (3 * u - 2) * v1;
  }
  long double acceleration(long double u) const {
    return (6 * (1 - 2 * u) * (p1 - p0) / t + (6 * u - 4) * v0 + (6 * u - 2) * v1) / t;
  }
};

/// What a drive does with a stream, compared with the path at every millisecond.
struct Execution {
  std::int64_t duration_ms = 0;
  double worst_deviation = 0.0;  ///< counts
  double peak_rpm = 0.0;
  double peak_acceleration = 0.0;  ///< rpm/s
  std::vector<double> worst_of_record;
};

/// Executes records that start at rest at `start` and at sample `first` of the path.
inline Execution execute_records(const std::vector<PvtRecord>& records, const PvtKnot& start,
                                 const trajectory::Path& path, const PvtEncoding& encoding) {
  const long double resolution = encoding.transmission.counts_per_revolution;
  const long double unit = encoding.velocity_unit_rpm * resolution / 60000;
  Execution result;
  result.duration_ms = start.sample;
  long double p0 = start.position;
  long double v0 = start.velocity * unit;
  for (const PvtRecord& record : records) {
    const BasisSegment segment{p0, v0, static_cast<long double>(record.position), record.velocity * unit,
                               static_cast<long double>(record.time)};
    double worst = 0.0;
    for (int k = 1; k <= record.time; ++k) {
      const long double u = static_cast<long double>(k) / record.time;
      const GoalTime time = path.start_time() + DriveMilliseconds(result.duration_ms + k);
      const double wanted = encoding.transmission.counts(time < path.end_time() ? path.sample(time).position
                                                                                : path.final_position());
      worst = std::max(worst, static_cast<double>(std::abs(segment.position(u) - wanted)));
    }
    for (int i = 0; i <= 64; ++i) {
      const auto rpm = static_cast<double>(std::abs(segment.velocity(i / 64.0L)) * 60000 / resolution);
      const auto acceleration =
          static_cast<double>(std::abs(segment.acceleration(i / 64.0L)) * 6e7L / resolution);
      result.peak_rpm = std::max(result.peak_rpm, rpm);
      result.peak_acceleration = std::max(result.peak_acceleration, acceleration);
    }
    result.worst_of_record.push_back(worst);
    result.worst_deviation = std::max(result.worst_deviation, worst);
    result.duration_ms += record.time;
    p0 = segment.p1;
    v0 = segment.v1;
  }
  return result;
}

inline std::int32_t rounded_start(const trajectory::Path& path, const PvtEncoding& encoding) {
  return static_cast<std::int32_t>(
      std::lround(encoding.transmission.counts(path.sample(path.start_time()).position)));
}

/// 2000 quadcounts, gear 100:1, the drive's limits far away.
inline PvtEncoding six_axis_encoding(double velocity_unit_rpm) {
  PvtEncoding encoding;
  encoding.joint = "elbow";
  encoding.transmission = {2000, 100, 1, 0.0};
  encoding.velocity_unit_rpm = velocity_unit_rpm;
  encoding.max_motor_rpm = 6000;
  encoding.max_motor_acceleration = 40000;
  return encoding;
}

}  // namespace interpolated_motion::encoding::testing
