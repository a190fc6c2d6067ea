#include "interpolated_motion_driver/axis/silverlode/ims_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/silverlode/ims_approach.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

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

class GoalEncoder : public TailEncoder {
 public:
  GoalEncoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
              const silverlode::LineMaster& line, std::int32_t rest_counts)
      : encoding_(ims_goal_encoding(parameters, delivery, line)),
        tried_(encoding_),
        filling_time_(ims_filling_time(parameters, delivery, line)),
        slots_(delivery.slot_rule(parameters.commit_horizon)),
        rest_counts_(rest_counts) {
    if (delivery.shortest_segment() > 0.0) tried_.bound_counts *= kTried;
  }

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const auto stream = encoding::encode_ims(path, tried_, rest_counts_);
    if (!stream) return stream.error();
    auto plan = std::make_unique<ImsPlan>();
    plan->path = path;
    plan->encoding = encoding_;
    plan->slots = slots_of(stream.value(), path.start_time());
    return TailPtr(std::move(plan));
  }

 private:
  // A segment must be there when the one before it has been executed.
  std::vector<RecordSlot> slots_of(const encoding::ImsStream& stream, GoalTime start) const {
    std::vector<double> begins{0.0};
    for (const ImsSegment& segment : stream.segments)
      begins.push_back(begins.back() + segment.time * encoding_.scale.tick);
    std::vector<RecordSlot> slots = slots_(begins);
    for (RecordSlot& slot : slots) {
      if (slot.release <= GoalTime{0.0}) slot.release = GoalTime{-filling_time_};
      slot.release += start;
      slot.deadline += start;
    }
    return slots;
  }

  encoding::ImsEncoding encoding_;
  encoding::ImsEncoding tried_;
  double filling_time_;
  SegmentDelivery::SlotRule slots_;
  std::int32_t rest_counts_;
};

/// A way on begins a little below the bound that was needed the last time, since bounds that are too narrow
/// take the longest to be refused.
class WayOnEncoder : public TailEncoder {
 public:
  WayOnEncoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
               const silverlode::LineMaster& line, const SegmentFeed& feed, GoalTime begin, Pace pace)
      : pace_(pace),
        encoding_(pace == Pace::Goal ? ims_goal_encoding(parameters, delivery, line)
                                     : ims_stream_encoding(parameters, delivery, line)),
        horizon_(ims_horizon(parameters, pace)),
        widest_(parameters.stream_deviation_bound),
        first_bound_(feed.bound() / 2.0),
        knot_(feed.knot()),
        begin_(begin),
        begins_(feed.begins_before_knot(delivery.capacity())),
        sent_(begins_.size() - 1 - (feed.unsent() > 1 ? feed.unsent() - 1 : 0)),
        records_per_segment_(delivery.records_per_segment()),
        slots_(delivery.slot_rule(parameters.commit_horizon)) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const trajectory::Path own = trajectory::shifted(path, GoalTime{0.0} - begin_);
    const auto plan = pace_ == Pace::Goal ? plan_ims_approach : plan_ims_way_on;
    auto approach = plan(own, encoding_, knot_, first_bound_, widest_);
    if (!approach) return approach.error();
    SegmentFeed::Manner manner{encoding_, horizon_};
    manner.encoding.bound_counts = approach.value().bound;
    auto way_on = std::make_unique<ImsWayOn>();
    way_on->from = knot_.goal_time;
    way_on->source = std::make_unique<SegmentFeed::Source>(own, manner, knot_);
    way_on->source->bounds = std::move(approach.value().bounds);
    way_on->widest = widest_;
    way_on->slots = slots_of(approach.value().ticks);
    return TailPtr(std::move(way_on));
  }

 private:
  /// Of the segments that have not been sent; the one that has been given out counts as sent.
  std::vector<RecordSlot> slots_of(const std::vector<std::int64_t>& ticks) const {
    std::vector<double> begins = begins_;
    for (const std::int64_t segment : ticks)
      begins.push_back(begins.back() + encoding_.scale.tick * static_cast<double>(segment));
    std::vector<RecordSlot> slots = slots_(begins);
    slots.erase(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(sent_ * records_per_segment_));
    for (RecordSlot& slot : slots) {
      slot.release += begin_;
      slot.deadline += begin_;
    }
    return slots;
  }

  Pace pace_;
  encoding::ImsEncoding encoding_;
  double horizon_;
  double widest_;
  double first_bound_;
  encoding::ImsKnot knot_;
  GoalTime begin_;
  std::vector<double> begins_;
  std::size_t sent_;  ///< of begins_
  std::size_t records_per_segment_;
  SegmentDelivery::SlotRule slots_;
};

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

TailEncoderPtr ims_goal_encoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                                const silverlode::LineMaster& line, std::int32_t rest_counts) {
  return std::make_unique<GoalEncoder>(parameters, delivery, line, rest_counts);
}

TailEncoderPtr ims_way_on_encoder(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                                  const silverlode::LineMaster& line, const SegmentFeed& feed, GoalTime begin,
                                  Pace pace) {
  return std::make_unique<WayOnEncoder>(parameters, delivery, line, feed, begin, pace);
}

double ims_horizon(const SilverlodeAxisParameters& parameters, Pace pace) {
  return pace == Pace::Stream ? parameters.stream_horizon : parameters.commit_horizon;
}

GoalTime ims_stream_lead(const SilverlodeAxisParameters& parameters, const SegmentDelivery& delivery,
                         const silverlode::LineMaster& line) {
  const auto ticks = ims_stream_encoding(parameters, delivery, line).max_segment_ticks;
  const double longest = parameters.scale.tick * static_cast<double>(ticks);
  return GoalTime{std::max(parameters.stream_horizon, kLeastAhead * longest) + longest};
}

}  // namespace interpolated_motion::axis
