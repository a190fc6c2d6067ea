#include "interpolated_motion_driver/axis/epos/pvt_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/axis/epos/fifo_watch.h"
#include "interpolated_motion_driver/encoding/record_range.h"
#include "interpolated_motion_driver/trajectory/remainder.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

namespace {

/// Longest record of a stream, ms: a record is committed as a whole. A prime number: were it in step with
/// SYNC, each report of the fill could come while a record is on its way, and none would tell of one that was
/// lost.
constexpr std::int64_t kLongestRecord = 23;
/// Reports of the fill within which a record that was lost is missed, even if a SYNC was lost with it: that
/// one, two in which its answers are waited for, and two reports, of which one may be in doubt. A drive that
/// is asked: four answers, one of which may be missed.
constexpr int kReports = 6;
constexpr int kAnswers = 4;

/// s of motion kept ahead: a lost record is to be missed before the drive gets there.
double horizon(const EposDevice& drive, double wanted) {
  const HostDuration noticed = drive.facts().free_records_mapped
                                   ? kReports * drive.master().parameters().sync_period
                                   : kAnswers * kFifoAskInterval + drive.node().sdo().timeout();
  return std::max(wanted, seconds(noticed));
}

/// A record is committed as a whole, and kLeastAhead of them are kept in the drive.
std::int64_t longest_record(double commit_horizon) {
  const double fits = 1e3 * commit_horizon / static_cast<double>(RecordFeed::kLeastAhead);
  return std::clamp(static_cast<std::int64_t>(fits), kLongestRecord, encoding::kMaxRecordTime);
}

encoding::PvtEncoding goal_encoding(const EposDevice& drive) {
  const EposAxisParameters& parameters = drive.parameters();
  const EposFacts& facts = drive.facts();
  encoding::PvtEncoding encoding;
  encoding.joint = parameters.joint;
  encoding.transmission = parameters.transmission;
  encoding.velocity_unit_rpm = facts.velocity_unit_rpm();
  encoding.bound_counts = parameters.deviation_bound;
  encoding.max_motor_rpm = facts.max_velocity * facts.velocity_unit_rpm();
  encoding.max_motor_acceleration = facts.max_acceleration;
  encoding.max_record_ms = longest_record(parameters.commit_horizon);
  return encoding;
}

encoding::PvtEncoding stream_encoding(const EposDevice& drive) {
  encoding::PvtEncoding encoding = goal_encoding(drive);
  encoding.max_record_ms = kLongestRecord;
  return encoding;
}

FeedLimits feed_limits(const EposDevice& drive, Pace pace) {
  const EposAxisParameters& parameters = drive.parameters();
  const double wanted = pace == Pace::Goal ? parameters.commit_horizon : parameters.stream_horizon;
  return {drive.facts().capacity, horizon(drive, wanted)};
}

class GoalEncoder : public TailEncoder {
 public:
  GoalEncoder(const EposDevice& drive, GoalTime wait, std::int32_t rest_counts)
      : encoding_(goal_encoding(drive)),
        limits_(feed_limits(drive, Pace::Goal)),
        wait_(wait),
        rest_counts_(rest_counts) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    auto stream = encoding::encode_pvt(path, encoding_, rest_counts_);
    if (!stream) return stream.error();
    auto plan = std::make_unique<PvtPlan>();
    plan->wait = encoding::rest_before(DriveMilliseconds{std::llround(wait_.count() * 1e3)}, stream.value());
    plan->feed.load(stream.value(), limits_);
    plan->start = path.start_time();
    plan->slots = plan->feed.slots(plan->start - plan->wait);
    return TailPtr(std::move(plan));
  }

 private:
  encoding::PvtEncoding encoding_;
  FeedLimits limits_;
  GoalTime wait_;
  std::int32_t rest_counts_;
};

class WayOnEncoder : public TailEncoder {
 public:
  WayOnEncoder(const EposDevice& drive, Pace pace, PvtJoin join)
      : encoding_(pace == Pace::Goal ? goal_encoding(drive) : stream_encoding(drive)),
        limits_(feed_limits(drive, pace)),
        widest_(drive.parameters().stream_deviation_bound),
        join_(std::move(join)) {}

  Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const override {
    const trajectory::Path rest = trajectory::remainder(path, join_.reached, join_.rate);
    const encoding::PvtKnot from{0, join_.knot.position, join_.knot.velocity};
    encoding::PvtEncoding encoding = encoding_;
    auto stream = encoding::encode_pvt(rest, encoding, from);
    while (!stream && 2.0 * encoding.bound_counts <= widest_) {
      encoding.bound_counts *= 2.0;
      stream = encoding::encode_pvt(rest, encoding, from);
    }
    if (!stream) return stream.error();
    auto way_on = std::make_unique<PvtWayOn>();
    way_on->from = join_.knot;
    way_on->stream = std::move(stream.value());
    way_on->limits = limits_;
    way_on->rate = join_.rate;
    way_on->slots = slots_behind(way_on->stream);
    return TailPtr(std::move(way_on));
  }

 private:
  std::vector<RecordSlot> slots_behind(const encoding::PvtStream& stream) const {
    RecordFeed feed = join_.before;
    feed.replace_uncommitted(stream, limits_);
    return feed.slots(join_.reached - GoalTime{1e-3 * static_cast<double>(join_.knot.sample)});
  }

  encoding::PvtEncoding encoding_;
  FeedLimits limits_;
  double widest_;
  PvtJoin join_;
};

}  // namespace

TailEncoderPtr pvt_goal_encoder(const EposDevice& drive, GoalTime wait, std::int32_t rest_counts) {
  return std::make_unique<GoalEncoder>(drive, wait, rest_counts);
}

Expected<TailPtr, Refusal> plan_pvt_standing(const EposDevice& drive, HostTime origin, GoalTime rest,
                                             std::int32_t rest_counts) {
  const double position = drive.parameters().transmission.joint_position(rest_counts);
  const trajectory::Path standing = trajectory::with_rest(trajectory::Path(position), rest);
  const auto stream = encoding::encode_pvt(standing, stream_encoding(drive), rest_counts);
  if (!stream) return stream.error();
  auto plan = std::make_unique<PvtPlan>();
  plan->feed.load(stream.value(), feed_limits(drive, Pace::Stream));
  plan->origin = origin;
  return TailPtr(std::move(plan));
}

TailEncoderPtr pvt_way_on_encoder(const EposDevice& drive, Pace pace, PvtJoin join) {
  return std::make_unique<WayOnEncoder>(drive, pace, std::move(join));
}

GoalTime pvt_stream_lead(const EposDevice& drive) {
  constexpr double kRecord = 1e-3 * kLongestRecord;
  const double kept =
      std::max(horizon(drive, drive.parameters().stream_horizon), RecordFeed::kLeastAhead * kRecord);
  return GoalTime{kept + kRecord};
}

}  // namespace interpolated_motion::axis
