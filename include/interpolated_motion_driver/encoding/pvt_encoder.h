#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/pvt_record.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

/// Everything that decides how one joint's path becomes PVT records.
struct PvtEncoding {
  std::string joint;                ///< for messages
  Transmission transmission;
  double velocity_unit_rpm = 1.0;   ///< rpm of the motor per unit of a record's velocity: 1, 0.1, 0.01 or 0.001 (0x608B)
  double bound_counts = 1.0;        ///< worst allowed deviation from the path at any drive sample, counts
  double max_motor_rpm = 0.0;       ///< peak of the emitted cubic, as the drive checks it (0x607F)
  double max_motor_acceleration = 0.0;  ///< rpm/s, peak of the emitted cubic, as the drive checks it (0x60C5)
  std::int64_t max_record_ms = 255;     ///< longest record, 1..255 ms
};

/// What executing one quantised record on the drive gives, computed before it is sent.
struct PvtCertificate {
  double worst_deviation_counts = 0.0;   ///< at any of the record's 1 ms samples, against the path
  double peak_rpm = 0.0;                 ///< absolute, of the emitted cubic
  double peak_acceleration = 0.0;        ///< rpm/s, absolute, of the emitted cubic
};

/// A whole path as PVT records. The first record's segment starts at `start_counts` at rest; sample k of the drive (ms
/// since interpolation became active) belongs to goal time path.start_time() + k ms.
struct PvtStream {
  std::int32_t start_counts = 0;             ///< where the drive stands when the first record begins
  std::vector<PvtRecord> records;            ///< without the terminating record (time = 0)
  std::vector<PvtCertificate> certificates;  ///< one per record
  DriveMilliseconds duration{0};             ///< sum of the records' times

  double worst_deviation_counts() const;
};

/// Encodes `path` for a drive whose demand stands at `start_counts`. The last record ends at rest on the path's final
/// position, rounded to the nearest count. Refuses, with joint, time and reason, a path that cannot be met within the
/// bound, that leaves the range of the record's fields, or whose emitted cubic would exceed the drive's limits.
Expected<PvtStream, Refusal> encode_pvt(const trajectory::Path& path, const PvtEncoding& encoding,
                                        std::int32_t start_counts);

}  // namespace interpolated_motion::encoding
