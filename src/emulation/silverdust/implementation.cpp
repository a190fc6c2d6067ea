#include "implementation.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kGlobalAddress = 255;
constexpr std::size_t kLongestAnswer = 64;

double tick_period_ns(const SilverDustParameters& p, double ppm) {
  return static_cast<double>(p.tick.count()) / (1.0 + ppm * 1e-6);
}

const SilverDustParameters& validated(const SilverDustParameters& parameters) {
  validate(parameters);
  return parameters;
}

}  // namespace

SilverDust::Implementation::Implementation(transport::VirtualSerialLine& line,
                                           transport::SerialListener& listener,
                                           const SilverDustParameters& parameters, HostTime now)
    : parameters_(validated(parameters)),
      line_(line),
      port_(line.add_port(listener)),
      now_(now),
      awake_at_(now),
      epoch_(now),
      period_ns_(tick_period_ns(parameters_, parameters_.clock_error_ppm)),
      address_(parameters_.address),
      group_(parameters_.group),
      ack_delay_(parameters_.ack_delay),
      profile_(parameters_),
      queue_(parameters_.queue_depth),
      interpolation_(parameters_, registers_, queue_, profile_),
      axis_(parameters_.plant) {
  text_.reserve(kLongestAnswer);
  restart(now, parameters_.awake_at_start ? now : now + parameters_.boot_time);
  profile_.place(parameters_.initial_position);
  axis_.place(parameters_.initial_position);
}

SilverDustCounters SilverDust::Implementation::counters() const {
  SilverDustCounters counters = counters_;
  const InterpolationCounters& interpolation = interpolation_.counters();
  counters.segments_executed = interpolation.segments_executed;
  counters.underruns = interpolation.underruns;
  counters.minimum_fill = interpolation.minimum_fill;
  return counters;
}

std::int32_t SilverDust::Implementation::position() const {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(axis_.counts()));
}

// Everything volatile is as after power-up; nothing is heard before `awake_at`.
void SilverDust::Implementation::restart(HostTime now, HostTime awake_at) {
  drop_answers(now);
  awake_ = false;
  awake_at_ = awake_at;
  parser_.reset();
  address_ = parameters_.address;
  group_ = parameters_.group;
  ack_delay_ = parameters_.ack_delay;
  registers_.clear();
  polling_ = PollingStatus{};
  latched_status_ = status_bit::kIndexFound | status_bit::kCalculationZero;
  temperature_ok_ = true;
  profile_.place(0);
  axis_.place(0.0);
  queue_.clear();
  interpolation_.abandon();
  program_.stop();
  motion_ = Motion::None;
  enabled_ = parameters_.enabled_at_power_up;
  killed_ = kill_keeps_driver_ = false;
  kill_enable_ = status_bit::kTemperatureOk;
  kill_state_ = 0;
  moving_limit_ = parameters_.moving_error_limit;
  holding_limit_ = parameters_.holding_error_limit;
  holding_delay_ = parameters_.holding_delay;
  holding_countdown_ = 0;
  largest_error_ = 0;
}

void SilverDust::Implementation::wake_up() {
  awake_ = true;
  epoch_ = awake_at_ + parameters_.tick_phase;
  ticks_ = 0;
}

void SilverDust::Implementation::power_cycle(HostTime now, HostDuration off) {
  catch_up(now);
  const HostDuration dark =
      off > kNever - now - parameters_.boot_time ? kNever - now : off + parameters_.boot_time;
  restart(now, now + dark);
}

void SilverDust::Implementation::silence(bool silent, HostTime now) {
  silent_ = silent;
  parser_.reset();
  if (silent) drop_answers(now);
}

void SilverDust::Implementation::drop_answers(HostTime now) {
  line_.connect(port_, false, now);
  line_.connect(port_, true, now);
}

void SilverDust::Implementation::set_clock_error(double ppm) {
  epoch_ = tick_time(ticks_);
  ticks_ = 0;
  period_ns_ = tick_period_ns(parameters_, ppm);
}

HostTime SilverDust::Implementation::tick_time(std::int64_t tick) const {
  return epoch_ + HostDuration(std::llround(static_cast<double>(tick) * period_ns_));
}

std::int64_t SilverDust::Implementation::ticks_until(HostTime now) const {
  if (now < epoch_) return 0;
  auto ticks = static_cast<std::int64_t>(static_cast<double>((now - epoch_).count()) / period_ns_);
  while (tick_time(ticks + 1) <= now) ++ticks;
  while (ticks > 0 && tick_time(ticks) > now) --ticks;
  return ticks;
}

HostTime SilverDust::Implementation::next_event() const {
  if (!observer_) return kNever;
  return awake_ ? tick_time(ticks_ + 1) : awake_at_;
}

void SilverDust::Implementation::catch_up(HostTime now) {
  if (!awake_ && awake_at_ <= now) wake_up();
  if (!awake_) return;
  const std::int64_t due = ticks_until(now);
  while (ticks_ < due) {
    if (!observer_ && resting()) {
      ticks_ = due;
      return;
    }
    ++ticks_;
    tick();
  }
}

bool SilverDust::Implementation::on_character(char value, HostTime time) {
  if (silent_) return false;
  if (!awake_) {
    if (time < awake_at_) return false;
    catch_up(time);
  }
  const auto packet = parser_.on_character(value);
  if (parser_.aborted() != aborted_seen_) {
    aborted_seen_ = parser_.aborted();
    polling_.raise(polling_bit::kAborted);
  }
  if (!packet) return false;
  on_packet(*packet, time);
  return true;
}

void SilverDust::Implementation::on_packet(const Packet& packet, HostTime time) {
  const bool own = packet.address == address_;
  const bool shared = packet.address == kGlobalAddress || (group_ != 0 && packet.address == group_);
  if (!own && !shared) return;
  catch_up(time);
  ++counters_.commands;
  now_ = time;
  // The answer comes in the settings the command was heard in.
  const int address = address_;
  const int delay = ack_delay_;
  Answer answer = execute(packet);
  if (!own || answer.kind == Answer::Kind::None) return;
  if (answer.kind == Answer::Kind::Nak) {
    ++counters_.naks;
    answer.echo = static_cast<std::uint16_t>(packet.command);
  }
  send(answer, address, time + delay * parameters_.tick + parameters_.turnaround);
}

void SilverDust::Implementation::send(const Answer& answer, int address, HostTime time) {
  text_.clear();
  const auto out = std::back_inserter(text_);
  switch (answer.kind) {
    case Answer::Kind::None:
      return;
    case Answer::Kind::Acknowledge:
      fmt::format_to(out, "* {:02X}", address);
      break;
    case Answer::Kind::Data:
      fmt::format_to(out, "# {:02X} {:04X}", address, answer.echo);
      for (std::size_t i = 0; i < answer.word_count; ++i) fmt::format_to(out, " {:04X}", answer.words[i]);
      break;
    case Answer::Kind::Nak:
      fmt::format_to(out, "! {:02X} {:04X} {:04X}", address, answer.echo, static_cast<unsigned>(answer.code));
      break;
  }
  text_.push_back('\r');
  line_.send(port_, text_, time);
}

}  // namespace interpolated_motion::emulation
