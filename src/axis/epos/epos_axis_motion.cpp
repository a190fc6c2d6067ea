#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/epos/epos_axis.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/interpolation_data_record.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
namespace object = cia402::object;
namespace cw = cia402::controlword;
using canopen::sdo_write;
using canopen::SdoResult;

namespace {

/// Longest from the start command to the drive's word that it plays (SYNC, its next sample, a TPDO), on a
/// host that is quick.
constexpr HostDuration kStartTimeout = 200ms;
/// Longest for the records of a prefill to get over the bus.
constexpr HostDuration kFillTimeout = 5s;
/// Longest the drive may take beyond the duration of a plan, for the error of its clock and the report.
constexpr HostDuration kOvertime = 500ms;
/// How often a FIFO is filled again when the drive holds another number of records than were sent.
constexpr int kLoadAttempts = 3;
/// The drive latches its state up to 2 samples after SYNC; records that arrive then may or may not be
/// counted.
constexpr HostDuration kLatchTime = 2ms;
/// Reports in a row that must contradict what was sent: one may be caught between two events.
constexpr int kFillMismatches = 3;
constexpr HostDuration kFillReadInterval = 50ms;
constexpr double kHalfSample = 0.5e-3;

/// A drive may be silent for `heartbeat_timeout` before it counts as lost; where that is long since frames
/// take their time to get here, so may be what is waited for.
HostDuration patience(HostDuration usual, const EposAxisParameters& parameters) {
  return std::max(usual, parameters.heartbeat_timeout / 2);
}

}  // namespace

// ---- plan and load
// -------------------------------------------------------------------------------------------------

encoding::PvtEncoding EposAxis::encoding() const {
  encoding::PvtEncoding encoding;
  encoding.joint = parameters_.joint;
  encoding.transmission = parameters_.transmission;
  encoding.velocity_unit_rpm = facts_.velocity_unit_rpm();
  encoding.bound_counts = parameters_.deviation_bound;
  encoding.max_motor_rpm = facts_.max_velocity * facts_.velocity_unit_rpm();
  encoding.max_motor_acceleration = facts_.max_acceleration;
  return encoding;
}

std::optional<Refusal> EposAxis::plan(const trajectory::Path& path, GoalTime wait) {
  auto stream = encoding::encode_pvt(path, encoding(), rest_counts_);
  if (!stream) return stream.error();
  planned_.wait = encoding::rest_before(DriveMilliseconds{std::llround(wait.count() * 1e3)}, stream.value());
  planned_.feed.load(stream.value(), {facts_.capacity, parameters_.commit_horizon});
  planned_.start = path.start_time();
  planned_.origin.reset();
  return std::nullopt;
}

void EposAxis::load(HostTime now) {
  feed_ = planned_.feed;
  wait_ = planned_.wait;
  stream_origin_ = planned_.origin;
  timeline_.begin(planned_.start - planned_.wait);
  finished_ = false;
  load_attempts_ = 0;
  clock_.stop();
  underruns_at_load_ = underruns_;
  refused_at_load_ = refused_writes_;
  minimum_fill_ = 0;
  start_loading(now);
}

void EposAxis::start_loading(HostTime now) {
  ++load_attempts_;
  feed_.rewind();
  node().clear_records();
  using cia402::kBufferClearAndClose;
  using cia402::kBufferOpen;
  read_rest({SdoSequence::write(sdo_write<std::uint8_t>(object::kBufferClear, kBufferClearAndClose)),
             SdoSequence::write(sdo_write<std::uint8_t>(object::kBufferClear, kBufferOpen))},
            Phase::Clearing, now);
}

void EposAxis::poll_clearing(HostTime now) {
  if (!sequence_done(now)) return;
  const std::int32_t expected = feed_.start_position();
  if (rest_counts_ > expected + 1 || rest_counts_ < expected - 1) {
    return fail(
        fmt::format(
            "its demand was {} counts when the goal was planned and is {} counts now: something else moves "
            "this drive",
            expected, rest_counts_),
        now);
  }
  records_due_ = node().rpdos_confirmed(epos_pdo::kRecordRpdo);
  enter_phase(Phase::Filling, now);
  feed(now);
}

void EposAxis::poll_filling(HostTime now) {
  if (expired(now, kFillTimeout))
    return fail("its records do not get onto the bus: is the bus overloaded or down?", now);
  if (node().rpdos_confirmed(epos_pdo::kRecordRpdo) < records_due_) return;
  enter_phase(Phase::Verifying, now);
  sequence().start({SdoSequence::read(object::kUsedRecords,
                                      [this](const SdoResult& r) -> std::optional<std::string> {
                                        if (!r.ok) return r.text();
                                        held_records_ = r.as_u16();
                                        return std::nullopt;
                                      })},
                   now);
}

// A PDO is not acknowledged by its receiver, so the number of records is compared before anything moves.
void EposAxis::poll_verifying(HostTime now) {
  if (!sequence_done(now)) return;
  if (held_records_ == feed_.sent()) {
    minimum_fill_ = held_records_;
    return enter_phase(Phase::Loaded, now);
  }
  if (held_records_ < feed_.sent())
    refused_writes_ += static_cast<std::uint32_t>(feed_.sent()) - held_records_;
  if (load_attempts_ < kLoadAttempts) return start_loading(now);
  fail(fmt::format("{} records were sent but its FIFO holds {} (0x60C4:04), {} times in a row", feed_.sent(),
                   held_records_, kLoadAttempts),
       now);
}

void EposAxis::feed(HostTime now) {
  while (const auto record = feed_.next(clock_.least_elapsed(now), clock_.elapsed(now))) {
    const auto bytes = cia402::pack({record->position, record->velocity, record->time});
    if (!node().send_record(epos_pdo::kRecordRpdo, bytes.data(), static_cast<std::uint8_t>(bytes.size())))
      return;
    feed_.mark_sent();
    ++records_due_;
    ++records_sent_;
  }
}

// ---- playing
// -------------------------------------------------------------------------------------------------------

void EposAxis::arm(HostTime, HostTime now) {
  if (phase() != Phase::Loaded) return;
  enter_phase(Phase::Armed, now);
  reports_taken_ = telemetry_.buffer_reports;
  fill_mismatches_ = 0;
  controlword().send(cw::kStartInterpolation, now);
}

HostTime EposAxis::path_begin() const { return clock_.running() ? clock_.host_time(wait_.count()) : kNever; }

/// The drive starts at its first sample after SYNC.
void EposAxis::start_clock() {
  if (clock_.running() || !controlword().applied()) return;
  clock_.start(master().last_sync_time() + host_duration(kHalfSample), facts_.takes_time_stamps);
  if (stream_origin_) timeline_.begin(GoalTime{seconds(clock_.start_time() - *stream_origin_)});
}

void EposAxis::poll_armed(HostTime now) {
  start_clock();
  if (!clock_.running()) {
    if (expired(now, patience(kStartTimeout, parameters_)))
      fail("its start command does not get onto the bus", now);
    return;
  }
  feed(now);
  if (telemetry_.statusword.ip_mode_active()) return enter_phase(Phase::Moving, now);
  if (feed_.all_sent() && clock_.least_elapsed(telemetry_.status_time) > feed_.duration())
    return end_of_motion(now);
  if (expired(now, patience(kStartTimeout, parameters_))) {
    fail(fmt::format("the drive does not start to interpolate; statusword: {}, FIFO: {}",
                     telemetry_.statusword.text(), telemetry_.buffer_status.text()),
         now);
  }
}

void EposAxis::poll_moving(HostTime now) {
  take_buffer_report(now);
  if (phase() != Phase::Moving) return;
  feed(now);
  watch_motion(now);
}

void EposAxis::watch_motion(HostTime now) {
  if (!telemetry_.statusword.ip_mode_active()) return end_of_motion(now);
  if (silence(now, feedback_.time) > parameters_.feedback_timeout) {
    return fail(
        fmt::format("no position has come from the drive for {:.2f} s", seconds(now - feedback_.time)), now);
  }
  const double overtime = seconds(patience(kOvertime, parameters_));
  if (clock_.least_elapsed(telemetry_.status_time) > feed_.duration() + overtime) {
    fail(fmt::format("the drive still interpolates {:.1f} s after the end of its records", overtime), now);
  }
}

void EposAxis::end_of_motion(HostTime now) {
  const auto too_early = [this] { return clock_.most_elapsed(telemetry_.status_time) < feed_.duration(); };
  if (clock_.follows_host() && too_early()) clock_.stop_following();
  if (!feed_.all_sent() || too_early()) {
    return fail(
        fmt::format("the drive left the interpolation {:.3f} s after the start instead of {:.3f} s; FIFO: {}",
                    clock_.elapsed(telemetry_.status_time), feed_.duration(),
                    telemetry_.buffer_status.text()),
        now);
  }
  rest_counts_ = feed_.final_position();
  enter_phase(Phase::Ending, now);
  controlword().send(cw::kEnableOperation, now);
}

// The next start needs a rising edge of bit 4, so the drive must have seen it fall.
void EposAxis::poll_ending(HostTime now) {
  if (!controlword().applied()) {
    if (controlword().overdue(now)) controlword().send(cw::kEnableOperation, now);
    return;
  }
  finished_ = true;
  enter_phase(Phase::Ready, now);
}

// ---- is everything that was sent in the FIFO?
// ----------------------------------------------------------------------

void EposAxis::take_buffer_report(HostTime now) {
  if (!facts_.free_records_mapped) return poll_fill_by_sdo(now);
  if (telemetry_.buffer_reports == reports_taken_) return;
  reports_taken_ = telemetry_.buffer_reports;
  if (telemetry_.free_records > facts_.capacity) return;
  const bool sent_meanwhile =
      node().rpdos_confirmed(epos_pdo::kRecordRpdo) < records_due_ ||
      node().last_rpdo_time(epos_pdo::kRecordRpdo) + kLatchTime > telemetry_.buffer_time;
  const bool started = clock_.least_elapsed(telemetry_.buffer_time) > 0.0;
  if (started && !sent_meanwhile) compare_fill(used_records(), telemetry_.buffer_time, now);
}

void EposAxis::poll_fill_by_sdo(HostTime now) {
  if (sequence().running() || now - fill_asked_ < kFillReadInterval) return;
  fill_asked_ = now;
  sequence().start({SdoSequence::read(object::kUsedRecords,
                                      [this](const SdoResult& r) -> std::optional<std::string> {
                                        if (!r.ok) return std::nullopt;
                                        telemetry_.free_records =
                                            facts_.capacity -
                                            std::min<std::uint32_t>(r.as_u16(), facts_.capacity);
                                        return std::nullopt;
                                      })},
                   now);
}

// What is in the FIFO is what was sent and not yet played. How far the drive has played is known within
// bounds; a fill outside of them means that a record got lost (or one came twice): the drive would cut a
// corner there. The FIFO is long, so it is stopped before it gets there.
//
// A drive that takes the host's time stamps may yet not set its clock by them: the first fill that
// contradicts host time ends that assumption, and what the fills have told about its crystal decides.
void EposAxis::compare_fill(std::size_t used, HostTime when, HostTime now) {
  learn_release(used, when);
  if (!feed_.all_sent()) minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(used));
  if (clock_.follows_host() && !expected_fill(when).contains(used)) clock_.stop_following();
  const FillRange expected = expected_fill(when);
  if (expected.contains(used)) {
    fill_mismatches_ = 0;
    return learn_clock(used, when);
  }
  if (++fill_mismatches_ < kFillMismatches) return;
  ++refused_writes_;
  fail(fmt::format("its FIFO holds {} records where {}..{} must be: a record was lost on the bus", used,
                   expected.least, expected.most),
       now);
}

EposAxis::FillRange EposAxis::expected_fill(HostTime when) const {
  const std::size_t sent = feed_.sent();
  const std::size_t most_played = feed_.played(clock_.most_elapsed(when)) + early_release_.value_or(1);
  const std::size_t least_played = feed_.played(clock_.least_elapsed(when)) + early_release_.value_or(0);
  return {sent - std::min(sent, most_played), sent - std::min(sent, least_played)};
}

/// While the drive is surely on its way to the first record, the records missing from the FIFO are those it
/// takes out early.
void EposAxis::learn_release(std::size_t used, HostTime when) {
  if (early_release_ || clock_.most_elapsed(when) >= feed_.end(0)) return;
  const std::size_t missing = feed_.sent() - std::min(feed_.sent(), used);
  if (missing <= 1) early_release_ = missing;
}

/// The reports that tell when a record was reached bound how far the drive has played.
void EposAxis::learn_clock(std::size_t used, HostTime when) {
  const std::size_t gone = feed_.sent() - used;
  const std::size_t reached = gone - std::min(gone, early_release_.value_or(1));
  const std::size_t not_reached = gone - std::min(gone, early_release_.value_or(0));
  if (reached >= 1) clock_.observe_at_least(when, feed_.end(reached - 1));
  if (not_reached < feed_.size()) clock_.observe_less_than(when, feed_.end(not_reached));
}

// ---- stopping
// ------------------------------------------------------------------------------------------------------

void EposAxis::stop(HostTime now) {
  node().clear_records();
  switch (phase()) {
    case Phase::Armed:
    case Phase::Moving:
      enter_phase(Phase::Braking, now);
      return controlword().send(cw::kStartInterpolation | cw::kHaltBit, now);
    case Phase::Ending:
      return;
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Verifying:
    case Phase::Loaded:
      return start_emptying(now);
    default:
      return;
  }
}

// With halt set, "target reached" means standstill. It counts when the drive has sent it after it took the
// halt.
bool EposAxis::halted() const {
  const bool fresh = controlword().applied() && telemetry_.status_time > master().last_sync_time() &&
                     telemetry_.motion_time > node().last_rpdo_time(epos_pdo::kControlwordRpdo) + kLatchTime;
  return fresh && telemetry_.statusword.target_reached();
}

void EposAxis::poll_braking(HostTime now) {
  if (halted()) {
    controlword().send(cw::kHalt, now);
    return start_emptying(now);
  }
  if (!controlword().applied() && controlword().overdue(now)) controlword().send(controlword().word(), now);
  const double longest = parameters_.limits.max_velocity / parameters_.limits.max_acceleration;
  if (expired(now, host_duration(2.0 * longest) + patience(kOvertime, parameters_))) {
    fail("the drive was told to halt but does not come to rest", now);
  }
}

void EposAxis::start_emptying(HostTime now) {
  read_rest({SdoSequence::write(sdo_write<std::uint8_t>(object::kBufferClear, cia402::kBufferClearAndClose))},
            Phase::Emptying, now);
}

// Halt is taken back last, when neither bit 4 nor a record could make the drive go on.
void EposAxis::poll_emptying(HostTime now) {
  if (!sequence_done(now) || !controlword().applied()) return;
  if (controlword().word() != cw::kEnableOperation) return controlword().send(cw::kEnableOperation, now);
  enter_phase(Phase::Ready, now);
}

// ---- a fault in motion
// ------------------------------------------------------------------------------------------------------

bool EposAxis::is_motion_phase() const { return is_playing() || phase() == Phase::Braking; }

/// The drive goes on through its FIFO, or until it misses the host's heartbeat if it hears nothing any more,
/// and then down its quick-stop ramp. Its last report shows that it could still be heard, and so hear, until
/// the SYNC after that.
HostDuration EposAxis::longest_motion(HostTime now) const {
  const double queued = feed_.time_ahead(clock_.least_elapsed(now)) * (1.0 + PlaybackClock::kMaxError);
  const HostTime misses_host =
      feedback_.time + master().parameters().sync_period + parameters_.heartbeat_timeout;
  const bool watches_host = parameters_.abort_connection_option != 0;
  const double alone = watches_host ? std::max(0.0, seconds(misses_host - now)) : queued;
  const double fastest = feed_.fastest_ahead(clock_.least_elapsed(now), counts_per_second(1));
  const double deceleration =
      parameters_.limits.max_acceleration * std::abs(parameters_.transmission.counts_per_radian());
  return host_duration(std::min(queued, alone) + fastest / deceleration);
}

/// It stays halted until the reset.
void EposAxis::press_stop(HostTime now) {
  constexpr std::uint16_t kStop = cw::kStartInterpolation | cw::kHaltBit;
  if (!obeys() || (controlword().word() == kStop && !controlword().overdue(now))) return;
  controlword().send(kStop, now);
  master().request_sync(now);
}

}  // namespace interpolated_motion::axis
