#include "interpolated_motion_driver/axis/epos/pvt_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpolated_motion_driver/axis/epos/fifo_watch.h"
#include "interpolated_motion_driver/encoding/record_range.h"
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

}  // namespace

Expected<PvtPlan, Refusal> plan_pvt_goal(const EposDevice& drive, const trajectory::Path& path, GoalTime wait,
                                         std::int32_t rest_counts) {
  auto stream = encoding::encode_pvt(path, goal_encoding(drive), rest_counts);
  if (!stream) return stream.error();
  PvtPlan plan;
  plan.wait = encoding::rest_before(DriveMilliseconds{std::llround(wait.count() * 1e3)}, stream.value());
  plan.feed.load(stream.value(), feed_limits(drive, Pace::Goal));
  plan.start = path.start_time();
  return plan;
}

Expected<PvtPlan, Refusal> plan_pvt_standing(const EposDevice& drive, HostTime origin, GoalTime rest,
                                             std::int32_t rest_counts) {
  const double position = drive.parameters().transmission.joint_position(rest_counts);
  const trajectory::Path standing = trajectory::with_rest(trajectory::Path(position), rest);
  const auto stream = encoding::encode_pvt(standing, stream_encoding(drive), rest_counts);
  if (!stream) return stream.error();
  PvtPlan plan;
  plan.feed.load(stream.value(), feed_limits(drive, Pace::Stream));
  plan.origin = origin;
  return plan;
}

Expected<PvtWayOn, Refusal> plan_pvt_way_on(const EposDevice& drive, const trajectory::Path& rest,
                                            const encoding::PvtKnot& knot, Pace pace) {
  const encoding::PvtKnot from{0, knot.position, knot.velocity};
  encoding::PvtEncoding encoding = pace == Pace::Goal ? goal_encoding(drive) : stream_encoding(drive);
  auto stream = encoding::encode_pvt(rest, encoding, from);
  while (!stream && 2.0 * encoding.bound_counts <= drive.parameters().stream_deviation_bound) {
    encoding.bound_counts *= 2.0;
    stream = encoding::encode_pvt(rest, encoding, from);
  }
  if (!stream) return stream.error();
  return PvtWayOn{std::move(stream.value()), feed_limits(drive, pace), 1.0};
}

GoalTime pvt_stream_lead(const EposDevice& drive) {
  constexpr double kRecord = 1e-3 * kLongestRecord;
  const double kept =
      std::max(horizon(drive, drive.parameters().stream_horizon), RecordFeed::kLeastAhead * kRecord);
  return GoalTime{kept + kRecord};
}

}  // namespace interpolated_motion::axis
