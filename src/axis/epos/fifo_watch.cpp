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
/// Reports in a row of one record less than was sent and not yet reached, which show that it is taken out
/// early.
constexpr int kTakenEarly = 3;

}  // namespace

void FifoWatch::begin() {
  reports_taken_ = drive_.report().buffer_reports;
  mismatches_ = 0;
  taken_early_ = 0;
  answer_.reset();
}

std::optional<std::string> FifoWatch::check(HostTime now) {
  const std::optional<Fill> fill = drive_.facts().free_records_mapped ? reported() : asked(now);
  if (!fill) return std::nullopt;
  const bool sent_meanwhile = !sender_.all_on_bus() || sender_.last_time() + kLatchTime > fill->from;
  const bool started = clock_.least_elapsed(fill->from) > 0.0;
  if (!started || sent_meanwhile) return std::nullopt;
  return compare(*fill);
}

std::optional<FifoWatch::Fill> FifoWatch::reported() {
  const EposTelemetry& report = drive_.report();
  const std::uint32_t capacity = drive_.facts().capacity;
  if (report.buffer_reports == reports_taken_) return std::nullopt;
  reports_taken_ = report.buffer_reports;
  if (report.free_records > capacity) return std::nullopt;
  return Fill{capacity - report.free_records, report.buffer_time, report.buffer_time};
}

/// The answer counts that has come since; and the drive is asked again when it is time.
std::optional<FifoWatch::Fill> FifoWatch::asked(HostTime now) {
  std::optional<Fill> fill;
  if (answer_) fill = Fill{*answer_, asked_, now};
  answer_.reset();
  if (sequence_.running() || now - asked_ < kFifoAskInterval) return fill;
  asked_ = now;
  const auto take = [this](const SdoResult& r) -> std::optional<std::string> {
    const std::uint32_t capacity = drive_.facts().capacity;
    if (!r.ok) return std::nullopt;
    answer_ = std::min<std::uint32_t>(r.as_u16(), capacity);
    drive_.report().free_records = capacity - *answer_;
    return std::nullopt;
  };
  sequence_.start({SdoSequence::read(cia402::object::kUsedRecords, take)}, now);
  return fill;
}

// A drive that takes the host's time stamps may yet not set its clock by them: the first fill that
// contradicts host time ends that assumption, and what the fills have told about its crystal decides.
std::optional<std::string> FifoWatch::compare(const Fill& fill) {
  const std::size_t used = fill.used;
  learn_release(fill);
  if (!feed_.all_sent()) minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(used));
  if (clock_.follows_host() && !expected(fill).contains(used)) clock_.stop_following();
  const FillRange range = expected(fill);
  if (range.contains(used)) {
    mismatches_ = 0;
    learn_clock(fill);
    return std::nullopt;
  }
  if (++mismatches_ < kMismatches) return std::nullopt;
  ++lost_;
  return fmt::format("its FIFO holds {} records where {}..{} must be: a record was lost on the bus", used,
                     range.least, range.most);
}

FifoWatch::FillRange FifoWatch::expected(const Fill& fill) const {
  const auto early = drive_.facts().early_release;
  const std::size_t sent = feed_.sent();
  const std::size_t most_played = feed_.played(clock_.most_elapsed(fill.until)) + early.value_or(1);
  const std::size_t least_played = feed_.played(clock_.least_elapsed(fill.from)) + early.value_or(0);
  return {sent - std::min(sent, most_played), sent - std::min(sent, least_played)};
}

/// Whether a drive takes a record out of its FIFO when it begins it, or when it has reached it. A report at
/// which it is surely on its way to a record tells: nothing can be lost yet before the first record is
/// reached; later one that is missing may be one that is lost, so it takes a few of them.
void FifoWatch::learn_release(const Fill& fill) {
  const std::size_t played = feed_.played(clock_.most_elapsed(fill.until));
  const bool known = played == feed_.played(clock_.least_elapsed(fill.from));
  if (!known || fill.used + played > feed_.sent()) return;
  const std::size_t missing = feed_.sent() - fill.used - played;
  taken_early_ = missing == 1 ? taken_early_ + 1 : 0;
  auto& early = drive_.facts().early_release;
  if (missing == 0) early = 0;
  if (!early && missing == 1 && (played == 0 || taken_early_ >= kTakenEarly)) early = 1;
}

/// The reports that tell when a record was reached bound how far the drive has played.
void FifoWatch::learn_clock(const Fill& fill) {
  const auto early = drive_.facts().early_release;
  const std::size_t gone = feed_.sent() - fill.used;
  const std::size_t reached = gone - std::min(gone, early.value_or(1));
  const std::size_t not_reached = gone - std::min(gone, early.value_or(0));
  if (reached >= 1) clock_.observe_at_least(fill.until, feed_.end(reached - 1));
  if (not_reached < feed_.size()) clock_.observe_less_than(fill.from, feed_.end(not_reached));
}

}  // namespace interpolated_motion::axis
