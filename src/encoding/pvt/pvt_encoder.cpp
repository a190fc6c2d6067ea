#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"

#include <algorithm>
#include <cmath>

#include "interpolated_motion_driver/encoding/record_range.h"
#include "interpolated_motion_driver/interpolation/cubic_hermite.h"
#include "pvt_refusals.h"

namespace interpolated_motion::encoding {

namespace {

SegmentRules rules_of(const PvtEncoding& encoding) {
  const double resolution = encoding.transmission.counts_per_revolution;
  SegmentRules rules;
  rules.velocity_unit = interpolation::counts_per_ms(encoding.velocity_unit_rpm, resolution);
  rules.bound = encoding.bound_counts;
  rules.max_velocity = interpolation::counts_per_ms(encoding.max_motor_rpm, resolution);
  rules.max_acceleration = interpolation::counts_per_ms2(encoding.max_motor_acceleration, resolution);
  rules.max_knot_velocity = std::min(rules.max_velocity, kMaxRecordVelocity * rules.velocity_unit);
  return rules;
}

/// Time a rest-to-rest record over `distance` counts needs within the limits: peaks 3 D / (2 T) and 6 D /
/// T^2.
double rest_to_rest_ms(double distance, const SegmentRules& rules) {
  return std::max(1.5 * distance / rules.max_velocity, std::sqrt(6 * distance / rules.max_acceleration));
}

/// A path of one sample is only a last rounding: it gets the time its one record needs.
PathSamples samples_of(const trajectory::Path& path, const PvtEncoding& encoding, const PvtKnot& from) {
  PathSamples samples(path, encoding.transmission, from.sample);
  if (samples.end() == 1 && from.sample == 0) {
    const double distance = std::abs(from.position - std::round(samples.final_position()));
    const double needed = std::ceil(rest_to_rest_ms(distance, rules_of(encoding)));
    samples.rest_until(
        static_cast<std::int64_t>(std::clamp(needed, 1.0, static_cast<double>(encoding.max_record_ms))));
  }
  return samples;
}

/// Checks first, as the members made from it rely on it.
const PvtEncoding& validated(const PvtEncoding& encoding) {
  encoding.validate();
  return encoding;
}

}  // namespace

double PvtStream::worst_deviation_counts() const {
  double worst = 0.0;
  for (const PvtCertificate& certificate : certificates) {
    worst = std::max(worst, certificate.worst_deviation_counts);
  }
  return worst;
}

PvtEncoder::PvtEncoder(const trajectory::Path& path, const PvtEncoding& encoding, const PvtKnot& from)
    : path_(&path),
      encoding_(validated(encoding)),
      search_(samples_of(path, encoding, from), rules_of(encoding), encoding.max_record_ms, from),
      checked_(from.sample) {}

Expected<bool, Refusal> PvtEncoder::next(PvtRecord& record, PvtCertificate& certificate) {
  if (finished()) return false;
  const std::int64_t last = search_.look_ahead();
  Refusal refusal;
  if (!check_ranges(last, refusal) || !check_start(refusal)) return refusal;
  KnotCandidate decided;
  if (!search_.next(decided)) return refuse_dead_end(*path_, encoding_, search_);
  record = {decided.knot.position, decided.knot.velocity, static_cast<std::uint8_t>(decided.duration)};
  certificate = certificate_of(decided.figures);
  return true;
}

bool PvtEncoder::check_start(Refusal& refusal) const {
  const double deviation = std::abs(knot().position - search_.samples().position(knot().sample));
  if (deviation <= encoding_.bound_counts) return true;
  refusal = refuse_start(*path_, encoding_, knot(), deviation);
  return false;
}

bool PvtEncoder::check_ranges(std::int64_t last, Refusal& refusal) {
  const PathSamples& samples = search_.samples();
  for (; checked_ <= last; ++checked_) {
    const double position = std::round(samples.position(checked_));
    const double velocity = std::round(samples.velocity(checked_) / search_.rules().velocity_unit);
    if (!fits_record_position(position)) {
      refusal = refuse_position(*path_, encoding_, checked_, position);
      return false;
    }
    if (!fits_record_velocity(velocity)) {
      refusal = refuse_velocity(*path_, encoding_, checked_, velocity);
      return false;
    }
  }
  return true;
}

PvtCertificate PvtEncoder::certificate_of(const SegmentFigures& figures) const {
  const double resolution = encoding_.transmission.counts_per_revolution;
  return {figures.deviation, interpolation::rpm(figures.peak_velocity, resolution),
          interpolation::rpm_per_second(figures.peak_acceleration, resolution)};
}

DriveMilliseconds rest_before(DriveMilliseconds rest, PvtStream& stream) {
  std::vector<PvtRecord> records;
  for (std::int64_t left = rest.count(); left > 0;) {
    const std::int64_t time = std::min(left, kMaxRecordTime);
    records.push_back({stream.start_counts, 0, static_cast<std::uint8_t>(time)});
    left -= time;
  }
  stream.records.insert(stream.records.begin(), records.begin(), records.end());
  stream.certificates.insert(stream.certificates.begin(), records.size(), PvtCertificate{});
  stream.duration += rest;
  return rest;
}

Expected<PvtStream, Refusal> encode_pvt(const trajectory::Path& path, const PvtEncoding& encoding,
                                        std::int32_t start_counts) {
  return encode_pvt(path, encoding, PvtKnot{0, start_counts, 0});
}

Expected<PvtStream, Refusal> encode_pvt(const trajectory::Path& path, const PvtEncoding& encoding,
                                        const PvtKnot& from) {
  PvtEncoder encoder(path, encoding, from);
  PvtStream stream;
  stream.start_counts = from.position;
  while (!encoder.finished()) {
    PvtRecord record;
    PvtCertificate certificate;
    const auto more = encoder.next(record, certificate);
    if (!more) return more.error();
    stream.records.push_back(record);
    stream.certificates.push_back(certificate);
  }
  stream.duration = DriveMilliseconds(encoder.knot().sample);
  return stream;
}

}  // namespace interpolated_motion::encoding
