#include "interpolated_motion_driver/emulation/silverdust/electronics.h"

namespace interpolated_motion::emulation {

Electronics::Electronics(const SilverDustParameters& parameters, PollingStatus& polling,
                         MotionControl& motion, StoredProgram& program)
    : enabled_at_power_up_(parameters.enabled_at_power_up),
      polling_(polling),
      motion_(motion),
      program_(program),
      status_(parameters),
      enabled_(enabled_at_power_up_) {}

void Electronics::restart() {
  status_.restart();
  conditions_ = KillMotorConditions{};
  enabled_ = enabled_at_power_up_;
  keeps_driver_ = false;
}

void Electronics::enable(bool on) {
  enabled_ = on;
  check_kill_conditions();
}

void Electronics::halt() {
  kill();
  latch(status_bit::kHalted, 0);
}

void Electronics::set_kill_conditions(std::uint16_t enable, std::uint16_t state) {
  conditions_.set(enable, state);
  check_kill_conditions();
}

void Electronics::clear_status() {
  status_.clear();
  check_kill_conditions();
}

void Electronics::over_temperature() {
  status_.set_over_temperature();
  check_kill_conditions();
}

void Electronics::latch(std::uint16_t status_bits, std::uint16_t polling_bits) {
  if (!status_.latch(status_bits)) return;
  polling_.raise(polling_bits);
  check_kill_conditions();
}

void Electronics::check_kill_conditions() {
  if (!conditions_.trip(status_.word(), enabled_)) return;
  polling_.raise(polling_bit::kShutDown);
  kill();
}

void Electronics::kill() {
  motion_.freeze();
  program_.stop();
  if (!keeps_driver_) enabled_ = false;
}

}  // namespace interpolated_motion::emulation
