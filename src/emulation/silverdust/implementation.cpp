#include "implementation.h"

namespace interpolated_motion::emulation {

namespace {

const SilverDustParameters& validated(const SilverDustParameters& parameters) {
  validate(parameters);
  return parameters;
}

}  // namespace

SilverDust::Implementation::Implementation(transport::VirtualSerialLine& line,
                                           transport::SerialListener& listener,
                                           const SilverDustParameters& parameters, HostTime now)
    : parameters_(validated(parameters)),
      serial_(line, listener, parameters_),
      clock_(parameters_, now),
      awake_at_(now),
      queue_(parameters_.queue_depth),
      limits_(parameters_),
      axis_(parameters_.plant),
      motion_(parameters_, register_file_, queue_, polling_, limits_),
      electronics_(parameters_, polling_, motion_, program_),
      registers_(parameters_, register_file_, motion_, axis_, limits_),
      program_target_(registers_, motion_, electronics_, polling_),
      interpreter_(parameters_, polling_, motion_, program_, command_chapters()) {
  restart(now, parameters_.awake_at_start ? now : now + parameters_.boot_time);
  motion_.place(parameters_.initial_position);
  axis_.place(parameters_.initial_position);
}

// What the commands of each chapter work on.
CommandRouter SilverDust::Implementation::command_chapters() {
  return CommandRouter(CommunicationCommands(parameters_, serial_), PollingCommands(parameters_, polling_),
                       StatusCommands(polling_, electronics_, motion_),
                       RegisterCommands(parameters_, registers_),
                       MotionCommands(motion_, axis_, program_, electronics_),
                       InterpolationCommands(parameters_, queue_, motion_, electronics_),
                       ProtectionCommands(electronics_, limits_), ProgramCommands(program_, motion_));
}

SilverDustCounters SilverDust::Implementation::counters() const {
  const InterpolationCounters& interpolation = motion_.interpolation().counters();
  SilverDustCounters counters;
  counters.segments_accepted = queue_.accepted();
  counters.segments_refused_full = queue_.refused();
  counters.segments_executed = interpolation.segments_executed;
  counters.underruns = interpolation.underruns;
  counters.minimum_fill = interpolation.minimum_fill;
  counters.commands = interpreter_.executed();
  counters.naks = serial_.naks();
  return counters;
}

// Everything volatile is as after power-up; nothing is heard before `awake_at`.
void SilverDust::Implementation::restart(HostTime now, HostTime awake_at) {
  awake_ = false;
  awake_at_ = awake_at;
  serial_.restart(now);
  polling_ = PollingStatus{};
  register_file_.clear();
  queue_.clear();
  limits_.restart();
  axis_.place(0.0);
  motion_.restart();
  program_.stop();
  electronics_.restart();
}

void SilverDust::Implementation::wake_up() {
  awake_ = true;
  clock_.restart(awake_at_ + parameters_.tick_phase);
}

void SilverDust::Implementation::power_cycle(HostTime now, HostDuration off) {
  catch_up(now);
  const HostDuration dark =
      off > kNever - now - parameters_.boot_time ? kNever - now : off + parameters_.boot_time;
  restart(now, now + dark);
}

void SilverDust::Implementation::raise_fault(SilverDustFault fault, HostTime now) {
  catch_up(now);
  if (!awake_) return;
  switch (fault) {
    case SilverDustFault::OverTemperature:
      return electronics_.over_temperature();
    case SilverDustFault::OverVoltage:
      return electronics_.over_voltage();
    case SilverDustFault::LowVoltage:
      return electronics_.low_voltage();
    case SilverDustFault::MovingError:
      return electronics_.moving_error();
    case SilverDustFault::HoldingError:
      return electronics_.holding_error();
  }
}

HostTime SilverDust::Implementation::next_event() const {
  if (!observer_) return kNever;
  return awake_ ? clock_.next() : awake_at_;
}

void SilverDust::Implementation::catch_up(HostTime now) {
  if (!awake_ && awake_at_ <= now) wake_up();
  if (!awake_) return;
  const std::int64_t due = clock_.due(now);
  while (clock_.ticks() < due) {
    if (!observer_ && resting()) return clock_.leap(due);
    clock_.advance();
    tick();
  }
}

bool SilverDust::Implementation::on_character(char value, HostTime time) {
  if (serial_.silent()) return false;
  if (!awake_) {
    if (time < awake_at_) return false;
    catch_up(time);
  }
  const auto packet = serial_.on_character(value, polling_);
  if (packet) on_packet(*packet, time);
  return packet.has_value();
}

void SilverDust::Implementation::on_packet(const Packet& packet, HostTime time) {
  if (!serial_.obeys(packet)) return;
  catch_up(time);
  const SerialInterface::Reply reply = serial_.reply_to(packet, time);
  const Answer answer = interpreter_.execute(packet);
  if (answer.kind() == Answer::Kind::Restart) return restart(time, time + parameters_.boot_time);
  serial_.send(answer, reply);
}

void SilverDust::Implementation::tick() {
  if (program_.running()) program_.tick(program_target_);
  const bool interpolating = motion_.interpolating();
  motion_.tick();
  if (electronics_.enabled()) {
    axis_.follow(motion_.target().position());
  } else {
    axis_.stand();
  }
  check_position_error();
  if (observer_) observe(interpolating);
}

void SilverDust::Implementation::check_position_error() {
  const std::int64_t error = motion_.target().counts() - axis_.counts();
  limits_.record(error);
  if (!electronics_.enabled()) return;
  switch (limits_.exceeded(error, motion_.active())) {
    case ErrorLimits::Excess::None:
      return;
    case ErrorLimits::Excess::Moving:
      return electronics_.moving_error();
    case ErrorLimits::Excess::Holding:
      return electronics_.holding_error();
  }
}

// A tick would change nothing.
bool SilverDust::Implementation::resting() const {
  if (motion_.active() || program_.running() || limits_.waiting()) return false;
  return !electronics_.enabled() || axis_.settled(motion_.target().position());
}

void SilverDust::Implementation::observe(bool interpolating) const {
  SilverDustSample sample;
  sample.time = clock_.last();
  sample.ticks_since_start = motion_.interpolation().ticks();
  sample.interpolating = interpolating;
  sample.demand = motion_.target().position();
  sample.velocity = motion_.target().counts_per_tick();
  sample.actual = position();
  observer_(sample);
}

}  // namespace interpolated_motion::emulation
