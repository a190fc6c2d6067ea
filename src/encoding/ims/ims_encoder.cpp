#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "ims_refusals.h"

namespace interpolated_motion::encoding {

namespace {

/// Sums of velocities beyond this leave too little room in 64 bits; at 4000 counts per revolution it is
/// 2^35 counts, sixteen turns of the drive's register.
constexpr double kMaxSum = 2305843009213693952.0;  // 2^61

constexpr double kMinRate = 0.5;
constexpr double kMaxRate = 2.0;

bool fits_sum(const ImsRules& rules, double counts) {
  return std::abs(counts) <= kMaxSum * rules.counts_per_unit;  // false for NaN
}

/// Checks first, as the members made from it rely on it.
const ImsEncoding& validated(const ImsEncoding& encoding) {
  encoding.validate();
  return encoding;
}

ImsSearch search_of(const trajectory::Path& path, const ImsEncoding& encoding, const ImsKnot& from) {
  const ImsRules rules(encoding);
  TickSamples samples(path, encoding.transmission, ImsSearch::window(rules));
  samples.restart(from.tick, from.goal_time, rules.scale.tick);
  const double final_counts = samples.final_counts();
  const std::int64_t target = fits_sum(rules, final_counts) ? std::llround(final_counts) : 0;
  ImsCandidate root;
  root.tick = from.tick;
  root.state = from.state;
  return {std::move(samples), rules, target, root};
}

}  // namespace

ImsEncoder::ImsEncoder(const trajectory::Path& path, const ImsEncoding& encoding, const ImsKnot& from)
    : path_(&path), encoding_(validated(encoding)), knot_(from), search_(search_of(path, encoding, from)) {}

void ImsEncoder::set_rate(double goal_seconds_per_drive_second) {
  if (!(goal_seconds_per_drive_second >= kMinRate && goal_seconds_per_drive_second <= kMaxRate)) {
    throw std::invalid_argument(fmt::format("Joint '{}': rate is {}, allowed is {} to {}.", encoding_.joint,
                                            goal_seconds_per_drive_second, kMinRate, kMaxRate));
  }
  const double seconds_per_tick = search_.rules().scale.tick * goal_seconds_per_drive_second;
  if (!finished() && seconds_per_tick != search_.seconds_per_tick()) search_.restart(seconds_per_tick);
}

double ImsEncoder::rate() const { return search_.seconds_per_tick() / search_.rules().scale.tick; }

Expected<bool, Refusal> ImsEncoder::next(ImsSegment& segment, ImsCertificate& certificate) {
  if (finished()) return false;
  Refusal refusal;
  if (!check_knot(refusal)) return refusal;
  ImsCandidate decided;
  const bool found = search_.next(decided) || (search_.take_back_restart() && search_.next(decided));
  if (!found) return refuse_dead_end(*path_, encoding_, search_);
  segment = segment_of(search_.rules(), knot_.state, decided.move);
  certificate = certificate_of(decided.figures);
  knot_ = {decided.tick, search_.samples().goal_time(decided.tick), decided.state};
  return true;
}

bool ImsEncoder::check_knot(Refusal& refusal) {
  const ImsRules& rules = search_.rules();
  const double final_counts = search_.samples().final_counts();
  const double position = interpolation::ims_counts(rules.scale, knot_.state);
  for (const double counts : {final_counts, position}) {
    if (fits_sum(rules, counts)) continue;
    refusal = refuse_position(encoding_, knot_.goal_time, counts, kMaxSum * rules.counts_per_unit);
    return false;
  }
  search_.samples().extend_to(knot_.tick);
  const double deviation = std::abs(position - *search_.samples().counts_from(knot_.tick));
  if (deviation <= encoding_.bound_counts) return true;
  refusal = refuse_start(encoding_, knot_.goal_time, position, deviation);
  return false;
}

ImsCertificate ImsEncoder::certificate_of(const ImsFigures& figures) const {
  const interpolation::ImsScale& scale = search_.rules().scale;
  const double rpm = 1.0 / scale.units_per_rpm();
  return {figures.deviation, static_cast<double>(figures.peak_velocity) * rpm,
          static_cast<double>(figures.peak_step) * rpm / scale.tick};
}

ImsSegment ims_terminator(const ImsSegment& last) {
  ImsSegment terminator = last;
  terminator.time = 0;
  return terminator;
}

Expected<ImsStream, Refusal> encode_ims(const trajectory::Path& path, const ImsEncoding& encoding,
                                        std::int32_t start_counts) {
  encoding.validate();
  const ImsKnot start{0, path.start_time(), interpolation::ims_at_rest(encoding.law(), start_counts)};
  ImsEncoder encoder(path, encoding, start);
  ImsStream stream;
  stream.start_counts = start_counts;
  while (!encoder.finished()) {
    ImsSegment segment;
    ImsCertificate certificate;
    const auto more = encoder.next(segment, certificate);
    if (!more) return more.error();
    stream.segments.push_back(segment);
    stream.certificates.push_back(certificate);
  }
  stream.terminator = ims_terminator(stream.segments.back());
  stream.duration = ServoTicks(encoder.knot().tick);
  return stream;
}

}  // namespace interpolated_motion::encoding
