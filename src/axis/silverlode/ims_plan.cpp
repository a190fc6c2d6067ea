#include "interpolated_motion_driver/axis/silverlode/ims_plan.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::axis {

namespace {

/// Longest segment of a stream, and least that the longest one of a goal may have, as multiple of the
/// shortest one: a segment is committed as a whole.
constexpr std::int64_t kLongest = 2;
/// Least that the longest segment of a goal may have, as multiple of the shortest that each drive of the line
/// can have at once: a calm axis leaves time to the others.
constexpr std::int64_t kCalm = 4;
/// Of the bound, the part with which a goal must be possible where segments may not be short: it is encoded
/// again as it is played, at the rate of the drive's crystal, and then other segments must be found.
constexpr double kTried = 0.95;

/// Ticks of a segment in which each drive of the line can be given a record.
std::int64_t segment_of_each(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                             const silverlode::LineMaster& line) {
  const double round = static_cast<double>(line.device_count()) * delivery.record_bus_time();
  return static_cast<std::int64_t>(std::ceil(round / parameters.scale.tick));
}

/// Ticks: kLeastAhead segments are kept in the drive, and each is committed as a whole.
std::int64_t longest_segment(const SilverlodeAxisParameters& parameters) {
  const double fits = parameters.commit_horizon / static_cast<double>(kLeastAhead) / parameters.scale.tick;
  return static_cast<std::int64_t>(fits);
}

// A segment must be there when the one before it has been executed.
std::vector<RecordSlot> slots_of(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                                 double filling_time, const encoding::ImsStream& stream, GoalTime start) {
  std::vector<double> begins{0.0};
  for (const ImsSegment& segment : stream.segments)
    begins.push_back(begins.back() + segment.time * parameters.scale.tick);
  std::vector<RecordSlot> slots = delivery.slots(begins, parameters.commit_horizon);
  for (RecordSlot& slot : slots) {
    if (slot.release <= GoalTime{0.0}) slot.release = GoalTime{-filling_time};
    slot.release += start;
    slot.deadline += start;
  }
  return slots;
}

}  // namespace

encoding::ImsEncoding ims_goal_encoding(const SilverlodeAxisParameters& parameters,
                                        const SegmentDelivery& delivery, const silverlode::LineMaster& line) {
  encoding::ImsEncoding encoding;
  encoding.joint = parameters.joint;
  encoding.transmission = parameters.transmission;
  encoding.scale = parameters.scale;
  encoding.bound_counts = parameters.deviation_bound;
  encoding.max_motor_rpm = parameters.scale.velocity_full_scale_rpm;
  encoding.max_motor_acceleration =
      parameters.limit_margin *
      std::abs(parameters.transmission.motor_rpm(parameters.limits.max_acceleration));
  const auto shortest =
      static_cast<std::int64_t>(std::ceil(delivery.shortest_segment() / parameters.scale.tick));
  encoding.min_segment_ticks = std::max(encoding.min_segment_ticks, shortest);
  const std::int64_t least = std::max(kCalm * static_cast<std::int64_t>(delivery.records_per_segment()) *
                                          segment_of_each(parameters, delivery, line),
                                      kLongest * encoding.min_segment_ticks);
  encoding.max_segment_ticks =
      std::max(std::min(encoding.max_segment_ticks, longest_segment(parameters)), least);
  return encoding;
}

encoding::ImsEncoding ims_stream_encoding(const SilverlodeAxisParameters& parameters,
                                          const SegmentDelivery& delivery,
                                          const silverlode::LineMaster& line) {
  encoding::ImsEncoding encoding = ims_goal_encoding(parameters, delivery, line);
  encoding.min_segment_ticks =
      std::max(encoding.min_segment_ticks, segment_of_each(parameters, delivery, line));
  encoding.max_segment_ticks = kLongest * encoding.min_segment_ticks;
  return encoding;
}

double ims_start_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                      const silverlode::LineMaster& line) {
  const auto records =
      static_cast<double>(line.device_count() * kSegmentsOfLead * delivery.records_per_segment());
  const auto request = silverlode::rio_request(silverlode::kMaxAddress);
  const HostDuration later = silverlode::real_exchange_time(line, request) - line.exchange_time(request);
  return parameters.start_lead + records * seconds(later) / parameters.line_share;
}

double ims_filling_time(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                        const silverlode::LineMaster& line) {
  const auto start = silverlode::ims_request(silverlode::kMaxAddress, parameters.ims_arguments);
  const double wait = static_cast<double>(delivery.records_per_segment()) * delivery.record_time();
  const double taken = static_cast<double>(line.device_count()) *
                       (seconds(silverlode::real_exchange_time(line, start)) + wait);
  return std::max(0.0, (1.0 - kLatestTold) * ims_start_lead(parameters, delivery, line) - taken);
}

Expected<ImsPlan, Refusal> plan_ims_goal(const SilverlodeAxisParameters& parameters,
                                         const SegmentDelivery& delivery, const silverlode::LineMaster& line,
                                         const trajectory::Path& path, std::int32_t rest_counts) {
  const encoding::ImsEncoding encoding = ims_goal_encoding(parameters, delivery, line);
  encoding::ImsEncoding tried = encoding;
  if (delivery.shortest_segment() > 0.0) tried.bound_counts *= kTried;
  const auto stream = encoding::encode_ims(path, tried, rest_counts);
  if (!stream) return stream.error();
  const double filling_time = ims_filling_time(parameters, delivery, line);
  return ImsPlan{path, slots_of(parameters, delivery, filling_time, stream.value(), path.start_time()),
                 std::nullopt, encoding};
}

std::vector<RecordSlot> ims_slots_in_motion(const SilverlodeAxisParameters& parameters,
                                            const SegmentDelivery& delivery,
                                            const std::vector<double>& begins, std::size_t sent,
                                            GoalTime start) {
  std::vector<RecordSlot> slots = delivery.slots(begins, parameters.commit_horizon);
  slots.erase(slots.begin(),
              slots.begin() + static_cast<std::ptrdiff_t>(sent * delivery.records_per_segment()));
  for (RecordSlot& slot : slots) {
    slot.release += start;
    slot.deadline += start;
  }
  return slots;
}

GoalTime ims_stream_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                         const silverlode::LineMaster& line) {
  const auto ticks = ims_stream_encoding(parameters, delivery, line).max_segment_ticks;
  const double longest = parameters.scale.tick * static_cast<double>(ticks);
  return GoalTime{std::max(parameters.stream_horizon, kLeastAhead * longest) + longest};
}

}  // namespace interpolated_motion::axis
