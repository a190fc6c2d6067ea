#include "interpolated_motion_driver/axis/epos/fifo_watch.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

namespace interpolated_motion::axis {

using namespace std::chrono_literals;
using canopen::SdoResult;

namespace {

/// The drive latches its state up to 2 samples after SYNC; records that arrive then may or may not be
/// counted.
constexpr HostDuration kLatchTime = 2ms;
/// Reports in a row that must contradict what was sent: one may be caught between two events.
constexpr int kMismatches = 2;
constexpr HostDuration kAskInterval = 50ms;

}  // namespace

void FifoWatch::begin() {
  reports_taken_ = drive_.report().buffer_reports;
  mismatches_ = 0;
}

std::optional<std::string> FifoWatch::check(HostTime now) {
  const EposTelemetry& report = drive_.report();
  const std::uint32_t capacity = drive_.facts().capacity;
  if (!drive_.facts().free_records_mapped) {
    ask(now);
    return std::nullopt;
  }
  if (report.buffer_reports == reports_taken_) return std::nullopt;
  reports_taken_ = report.buffer_reports;
  if (report.free_records > capacity) return std::nullopt;
  const bool sent_meanwhile = !sender_.all_on_bus() || sender_.last_time() + kLatchTime > report.buffer_time;
  const bool started = clock_.least_elapsed(report.buffer_time) > 0.0;
  if (!started || sent_meanwhile) return std::nullopt;
  return compare(capacity - report.free_records, report.buffer_time);
}

void FifoWatch::ask(HostTime now) {
  if (sequence_.running() || now - asked_ < kAskInterval) return;
  asked_ = now;
  const auto take = [this](const SdoResult& r) -> std::optional<std::string> {
    const std::uint32_t capacity = drive_.facts().capacity;
    if (r.ok) drive_.report().free_records = capacity - std::min<std::uint32_t>(r.as_u16(), capacity);
    return std::nullopt;
  };
  sequence_.start({SdoSequence::read(cia402::object::kUsedRecords, take)}, now);
}

// A drive that takes the host's time stamps may yet not set its clock by them: the first fill that
// contradicts host time ends that assumption, and what the fills have told about its crystal decides.
std::optional<std::string> FifoWatch::compare(std::size_t used, HostTime when) {
  learn_release(used, when);
  if (!feed_.all_sent()) minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(used));
  if (clock_.follows_host() && !expected_fill(when).contains(used)) clock_.stop_following();
  const FillRange expected = expected_fill(when);
  if (expected.contains(used)) {
    mismatches_ = 0;
    learn_clock(used, when);
    return std::nullopt;
  }
  if (++mismatches_ < kMismatches) return std::nullopt;
  ++lost_;
  return fmt::format("its FIFO holds {} records where {}..{} must be: a record was lost on the bus", used,
                     expected.least, expected.most);
}

FifoWatch::FillRange FifoWatch::expected_fill(HostTime when) const {
  const auto early = drive_.facts().early_release;
  const std::size_t sent = feed_.sent();
  const std::size_t most_played = feed_.played(clock_.most_elapsed(when)) + early.value_or(1);
  const std::size_t least_played = feed_.played(clock_.least_elapsed(when)) + early.value_or(0);
  return {sent - std::min(sent, most_played), sent - std::min(sent, least_played)};
}

/// While the drive is surely on its way to the first record, the records missing from the FIFO are those it
/// takes out early.
void FifoWatch::learn_release(std::size_t used, HostTime when) {
  if (drive_.facts().early_release || clock_.most_elapsed(when) >= feed_.end(0)) return;
  const std::size_t missing = feed_.sent() - std::min(feed_.sent(), used);
  if (missing <= 1) drive_.facts().early_release = missing;
}

/// The reports that tell when a record was reached bound how far the drive has played.
void FifoWatch::learn_clock(std::size_t used, HostTime when) {
  const auto early = drive_.facts().early_release;
  const std::size_t gone = feed_.sent() - used;
  const std::size_t reached = gone - std::min(gone, early.value_or(1));
  const std::size_t not_reached = gone - std::min(gone, early.value_or(0));
  if (reached >= 1) clock_.observe_at_least(when, feed_.end(reached - 1));
  if (not_reached < feed_.size()) clock_.observe_less_than(when, feed_.end(not_reached));
}

}  // namespace interpolated_motion::axis
