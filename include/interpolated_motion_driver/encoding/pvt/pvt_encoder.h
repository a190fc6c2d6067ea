#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/encoding/pvt/knot_search.h"
#include "interpolated_motion_driver/encoding/pvt/segment_fit.h"
#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/interpolation/pvt_record.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

/// Everything that decides how one joint's path becomes PVT records.
struct PvtEncoding {
  std::string joint;          ///< for messages
  Transmission transmission;  ///< between joint units and counts
  double velocity_unit_rpm =
      1.0;  ///< rpm of the motor per unit of a record's velocity: 1, 0.1, 0.01 or 0.001 (0x608B)
  double bound_counts = 1.0;            ///< worst allowed deviation from the path at any drive sample, counts
  double max_motor_rpm = 0.0;           ///< peak of the emitted cubic, as the drive checks it (0x607F)
  double max_motor_acceleration = 0.0;  ///< rpm/s, peak of the emitted cubic, as the drive checks it (0x60C5)
  std::int64_t max_record_ms = 255;     ///< longest record, 1..255 ms

  /// Throws std::invalid_argument with joint, parameter, value and allowed range. Infinite limits are
  /// allowed. To be called when the configuration is read; the encoder calls it again, so that it never works
  /// with such values.
  void validate() const;
};

/// What executing one quantised record on the drive gives, computed before it is sent.
struct PvtCertificate {
  double worst_deviation_counts = 0.0;  ///< at any of the record's 1 ms samples, against the path
  double peak_rpm = 0.0;                ///< absolute, of the emitted cubic
  double peak_acceleration = 0.0;       ///< rpm/s, absolute, of the emitted cubic
};

/// A whole path as PVT records. The first record's segment starts at `start_counts` at rest; sample k of the
/// drive (ms since interpolation became active) belongs to goal time path.start_time() + k ms.
struct PvtStream {
  std::int32_t start_counts = 0;             ///< where the drive stands when the first record begins
  std::vector<PvtRecord> records;            ///< without the terminating record (time = 0)
  std::vector<PvtCertificate> certificates;  ///< one per record
  DriveMilliseconds duration{0};             ///< sum of the records' times

  /// Of all certificates, counts; 0 without records.
  double worst_deviation_counts() const;
};

/// Puts records before the first of `stream` that keep the drive where it stands for `rest`, and returns
/// `rest`.
DriveMilliseconds rest_before(DriveMilliseconds rest, PvtStream& stream);

/// Encodes a path record by record, from any knot on.
class PvtEncoder {
 public:
  /// Continues from `from`, where the drive's motion stands at that sample of the path; its position must be
  /// within the bound of the path there. `path` must outlive this object. Throws as PvtEncoding::validate().
  PvtEncoder(const trajectory::Path& path, const PvtEncoding& encoding, const PvtKnot& from);

  /// Where the record given last ends; at first `from`.
  const PvtKnot& knot() const { return search_.knot(); }

  /// Whether knot() is the last: at rest on the path's final position.
  bool finished() const { return search_.finished(); }

  /// One more record with its certificate: true, or false if there is none after knot(). Allocates only for a
  /// refusal, and after a refusal there is nothing more to ask for. See encode_pvt() for what is refused.
  Expected<bool, Refusal> next(PvtRecord& record, PvtCertificate& certificate);

 private:
  bool check_start(Refusal& refusal) const;
  bool check_ranges(std::int64_t last, Refusal& refusal);
  PvtCertificate certificate_of(const SegmentFigures& figures) const;

  const trajectory::Path* path_;
  PvtEncoding encoding_;
  KnotSearch search_;
  std::int64_t checked_;  ///< samples before this one are within the ranges of a record's fields
};

/// Encodes `path` for a drive whose demand stands at `start_counts`. The last record ends at rest on the
/// path's final position, rounded to the nearest count, at the first millisecond not before the path's end.
/// Refuses, with joint, time and reason, a path that starts farther than the bound from `start_counts`, that
/// cannot be met within the bound, that leaves the range of the record's fields, or whose emitted cubic would
/// exceed the drive's limits. As the cubic between rounded knots peaks somewhat above the path itself, the
/// drive's limits need to be a little above the path's. Throws std::invalid_argument as
/// PvtEncoding::validate().
Expected<PvtStream, Refusal> encode_pvt(const trajectory::Path& path, const PvtEncoding& encoding,
                                        std::int32_t start_counts);

/// The same from a knot on where the drive may be in motion: `from` is at the path's start.
Expected<PvtStream, Refusal> encode_pvt(const trajectory::Path& path, const PvtEncoding& encoding,
                                        const PvtKnot& from);

}  // namespace interpolated_motion::encoding
