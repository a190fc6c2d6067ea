#pragma once

#include <cstdint>

#include "interpolated_motion_driver/encoding/ims/ims_encoding.h"
#include "interpolated_motion_driver/encoding/ims/ims_search.h"
#include "interpolated_motion_driver/interpolation/ims_segment.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"

namespace interpolated_motion::encoding {

/// Encodes a path as IMS segments ("Interpolated Motion", QCI-TD044), one by one, from any knot on.
///
/// A segment is a ramp or a hold; reversals are split at zero speed; the last moving segment names the path's
/// final position, starts braking at once and lands on it exactly. Each is executed in the drive's integers
/// before it is given out, and the next one starts from the state reached, so no rounding adds up.
class ImsEncoder {
 public:
  /// Continues from `from`, which must be within the bound of the path. `path` must outlive this object.
  /// Throws as ImsEncoding::validate(). Takes its memory here: max_segment_ticks decides how much.
  ImsEncoder(const trajectory::Path& path, const ImsEncoding& encoding, const ImsKnot& from);

  /// Where the segment given last ends; at first `from`.
  const ImsKnot& knot() const { return knot_; }

  /// Whether knot() is the last: at rest on the path's final position, at the path's end or after it.
  bool finished() const { return search_.finished(); }

  /// Goal time that passes from knot() on in a second of the drive's own clock (default 1, allowed 0.5..2):
  /// tick k after knot() is at goal time knot().goal_time + k * tick * rate. So a drive whose crystal is fast
  /// by 100 ppm is given 1 / 1.0001. Throws std::invalid_argument.
  /// Where the way on from knot() is too narrow for it, the rate of the segment before is kept, see rate().
  void set_rate(double goal_seconds_per_drive_second);
  double rate() const;

  /// One more segment with its certificate: true, or false if there is none after knot(). Allocates only for
  /// a refusal, and after a refusal there is nothing more to ask for. See encode_ims() for what is refused.
  Expected<bool, Refusal> next(ImsSegment& segment, ImsCertificate& certificate);

 private:
  bool check_knot(Refusal& refusal);
  ImsCertificate certificate_of(const ImsFigures& figures) const;

  const trajectory::Path* path_;
  ImsEncoding encoding_;
  ImsKnot knot_;
  ImsSearch search_;
};

/// The segment that ends the interpolated motion after `last`: time 0, the rest repeated.
ImsSegment ims_terminator(const ImsSegment& last);

/// Encodes `path` for a drive whose demand stands at rest at `start_counts`, the first tick at the path's
/// start. Ends at rest on the path's final position, rounded to the nearest count, at the path's end or, as
/// the landing may take a little longer, some ticks after it. Positions that leave the 32 bits of the drive's
/// register wrap around as the drive's do.
/// Refuses, with joint, time and reason, a path that starts farther than the bound from `start_counts`, that
/// cannot be met within the bound, or that would exceed the limits of velocity or acceleration. Between
/// segments the acceleration steps, so the limit needs to be a little above the path's own peak. Throws
/// std::invalid_argument as ImsEncoding::validate().
Expected<ImsStream, Refusal> encode_ims(const trajectory::Path& path, const ImsEncoding& encoding,
                                        std::int32_t start_counts);

}  // namespace interpolated_motion::encoding
