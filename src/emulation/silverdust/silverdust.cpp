#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

#include "implementation.h"

namespace interpolated_motion::emulation {

SilverDust::SilverDust(transport::VirtualSerialLine& line, const SilverDustParameters& parameters,
                       HostTime now)
    : implementation_(std::make_unique<Implementation>(line, *this, parameters, now)) {}

SilverDust::~SilverDust() = default;

const SilverDustParameters& SilverDust::parameters() const { return implementation_->parameters(); }

SilverDustCounters SilverDust::counters() const { return implementation_->counters(); }

void SilverDust::set_sample_observer(SampleObserver observer) {
  implementation_->set_sample_observer(std::move(observer));
  next_event_ = implementation_->next_event();
}

std::int32_t SilverDust::position() const { return implementation_->position(); }

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

void SilverDust::process(HostTime now) {
  implementation_->catch_up(now);
  next_event_ = implementation_->next_event();
}

void SilverDust::on_character(char value, HostTime time) {
  if (implementation_->on_character(value, time)) next_event_ = implementation_->next_event();
}

}  // namespace interpolated_motion::emulation
