#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

#include <string>
#include <utility>

#include "implementation.h"

namespace interpolated_motion::emulation {
namespace {

// Numbers of commands and of reasons as the packet protocol has them, and more, so that any can be tried.
constexpr FaultNumber kCommand{"COMMAND", 0.0, 255.0};
constexpr FaultNumber kReason{"CODE", 0.0, 255.0};

DemandSample demand_of(const SilverDustSample& sample, double tick) {
  return {sample.time,
          tick * static_cast<double>(sample.ticks_since_start),
          sample.demand,
          sample.actual,
          sample.velocity / tick,
          sample.interpolating};
}

}  // namespace

SilverDust::SilverDust(transport::VirtualSerialLine& line, const SilverDustParameters& parameters,
                       HostTime now)
    : implementation_(std::make_unique<Implementation>(line, *this, parameters, now)) {}

SilverDust::~SilverDust() = default;

const SilverDustParameters& SilverDust::parameters() const { return implementation_->parameters(); }

SilverDustCounters SilverDust::counters() const { return implementation_->counters(); }

void SilverDust::observe(Observer observer) {
  if (!observer) return set_sample_observer({});
  const double tick = seconds(parameters().tick);
  set_sample_observer([observer = std::move(observer), tick](const SilverDustSample& sample) {
    observer(demand_of(sample, tick));
  });
}

void SilverDust::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
  next_event_ = implementation_->next_event();
}

std::int32_t SilverDust::position() const { return implementation_->position(); }

bool SilverDust::has_torque() const { return implementation_->has_torque(); }

void SilverDust::load_program(std::vector<ProgramStep> steps) {
  implementation_->load_program(std::move(steps));
}

void SilverDust::power_cycle(HostTime now, HostDuration off) {
  implementation_->power_cycle(now, off);
  next_event_ = implementation_->next_event();
}

void SilverDust::stall(bool blocked) { implementation_->stall(blocked); }

void SilverDust::raise_fault(SilverDustFault fault, HostTime now) {
  implementation_->raise_fault(fault, now);
}

void SilverDust::silence(bool silent, HostTime now) { implementation_->silence(silent, now); }

void SilverDust::set_clock_error(double ppm) {
  implementation_->set_clock_error(ppm);
  next_event_ = implementation_->next_event();
}

void SilverDust::refuse_next(int command, int code, int count) {
  implementation_->refuse_next({command, static_cast<NakCode>(code), count});
}

std::vector<FaultCommand> SilverDust::own_faults(HostTime now) {
  const auto fault = [this, now](const std::string& name, SilverDustFault kind) -> FaultCommand {
    return {"fault " + name, {}, [this, now, kind](const FaultCommand::Numbers&) { raise_fault(kind, now); }};
  };
  return {fault("over_temperature", SilverDustFault::OverTemperature),
          fault("over_voltage", SilverDustFault::OverVoltage),
          fault("low_voltage", SilverDustFault::LowVoltage),
          fault("moving_error", SilverDustFault::MovingError),
          fault("holding_error", SilverDustFault::HoldingError),
          {"nak", {kCommand, kReason, kFaultCount}, [this](const FaultCommand::Numbers& n) {
             refuse_next(static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]));
           }}};
}

void SilverDust::process(HostTime now) {
  implementation_->catch_up(now);
  next_event_ = implementation_->next_event();
}

void SilverDust::on_character(char value, HostTime time) {
  if (implementation_->on_character(value, time)) next_event_ = implementation_->next_event();
}

}  // namespace interpolated_motion::emulation
