#include "simulation/invariants/limits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

constexpr double kInterval = 0.95;  // share of Joint::difference, least between samples that are compared
constexpr double kGap = 0.005;      // s besides that: samples further apart belong to different motions
/// Counts: a demand is rounded to counts where its records are, and a joint at its limit stands at the next
/// count.
constexpr double kPositionSlack = 2.0;
/// Of the deviation bound, for velocity: a path at the limit may be left by the bound within the shortest
/// record (5 ms).
constexpr double kShortestRecord = 0.005;
/// s: a drive that has lost target positions on its bus steps back to the path with the next ones, and the
/// host cannot know.
constexpr double kLostTargets = 0.5;
constexpr double kAfterStream = 1.5;  // s, in which an arm has come to rest behind the newest setpoint
constexpr double kAfterAbsence =
    0.5;  // s, in which the clocks of drives that follow SYNC are themselves again

/// What rounding may add to an acceleration, counts/s^2. Target positions are half a count off at most, so
/// the velocities of two cubics that meet differ by up to 8 counts / 3 periods (their fourth difference), and
/// each bends by up to 2 counts / period^2.
double rounding(const Joint& joint) {
  const double of_bound = 2.0 * joint.deviation_bound / (kShortestRecord * kShortestRecord);
  const double period = joint.target_period;
  if (period <= 0.0) return of_bound;
  return std::max(of_bound, 8.0 / (3.0 * period * joint.difference) + 2.0 / (period * period));
}

}  // namespace

void Limits::check_position(const Joint& joint, const Sample& sample) {
  const double slack = (kPositionSlack + joint.deviation_bound) * joint.count();
  if (sample.demand >= joint.min_position - slack && sample.demand <= joint.max_position + slack) return;
  fail(fmt::format("{}: its drive demands {:.5f} rad, outside {}..{} rad", joint.label(), sample.demand,
                   joint.min_position, joint.max_position));
}

// limit_margin (1.2) is what docs/configuration.md lets a record exceed the limits by.
void Limits::check_motion(const Joint& joint, const Track& before, const Track& now) {
  const double allowed =
      joint.limit_margin * joint.max_velocity + joint.deviation_bound * joint.count() / kShortestRecord;
  if (std::abs(now.velocity) > allowed) {
    return fail(
        fmt::format("{}: its drive demands {:.4f} rad/s while the group is {}{}, allowed {:.4f} (limit {})",
                    joint.label(), now.velocity, motion::to_string(ledger().state()), circumstance(now.time),
                    allowed, joint.max_velocity));
  }
  if (before.known < 2) return;
  const double acceleration = (now.velocity - before.velocity) / (0.5 * (now.step + before.step));
  const double most = joint.limit_margin * joint.max_acceleration + rounding(joint) * joint.count();
  if (std::abs(acceleration) <= most) return;
  fail(fmt::format("{}: its drive demands {:.3f} rad/s^2 while the group is {}{}, allowed {:.3f} (limit {})",
                   joint.label(), acceleration, motion::to_string(ledger().state()), circumstance(now.time),
                   most, joint.max_acceleration));
}

const char* Limits::circumstance(HostTime when) const {
  const HostTime absence = ledger().last_absence();
  const bool recent = absence != HostTime{} && seconds(when - absence) <= kAfterAbsence;
  if (recent) return " after the host was away";
  const HostTime setpoint = ledger().last_setpoint();
  const bool streams = setpoint != HostTime::min() && seconds(when - setpoint) <= kAfterStream;
  return streams ? " in or after a stream" : "";
}

bool Limits::is_not_led(const Joint& joint, HostTime when) const {
  return ledger().has_fault(joint.bus, when, kLostTargets) ||
         ledger().are_drives_alone(when, joint.target_period);
}

// Samples are a whole number of sample periods apart by the drive's clock; what the host's clock says besides
// is the drive's crystal, and the steps of one that follows SYNC.
void Limits::sample(const Sample& sample) {
  const Joint& joint = arm().joints[sample.joint];
  if (joint.kind == "cyclic" && is_not_led(joint, sample.time)) {
    tracks_[sample.joint] = {};
    return;
  }
  check_position(joint, sample);
  Track& track = tracks_[sample.joint];
  const bool follows = track.known > 0 && seconds(sample.time - track.time) < joint.difference + kGap;
  if (!follows) {
    track = {sample.time, sample.demand, 0.0, 0.0, 1};
    return;
  }
  const double step =
      std::round(seconds(sample.time - track.time) / joint.sample_period) * joint.sample_period;
  if (step < kInterval * joint.difference) return;
  const Track now{sample.time, sample.demand, step, (sample.demand - track.position) / step, 2};
  check_motion(joint, track, now);
  track = now;
}

}  // namespace interpolated_motion::simulation
