#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"

namespace interpolated_motion::emulation {

MotionControl::MotionControl(const SilverDustParameters& parameters, RegisterFile& registers,
                             SegmentQueue& queue, PollingStatus& status, ErrorLimits& limits)
    : acceleration_full_scale_(parameters.acceleration_full_scale),
      status_(status),
      limits_(limits),
      profile_(parameters),
      interpolation_(parameters, registers, queue, profile_) {}

void MotionControl::restart() {
  profile_.place(0);
  interpolation_.abandon();
  motion_ = Motion::None;
}

void MotionControl::move_to(std::int32_t goal, std::int64_t acceleration, std::int64_t velocity) {
  step_ = profile_step(acceleration);
  profile_.move_to(goal, {step_, step_}, velocity);
  motion_ = Motion::Profile;
}

void MotionControl::run_at(std::int64_t velocity, std::int64_t acceleration) {
  interpolation_.abandon();
  step_ = profile_step(acceleration);
  profile_.run_at(velocity, step_);
  motion_ = Motion::Profile;
}

void MotionControl::interpolate() {
  interpolation_.start();
  motion_ = Motion::Interpolated;
}

void MotionControl::stop(std::int64_t deceleration) {
  const std::int64_t running = interpolating() ? interpolation_.step() : step_;
  step_ = deceleration == 0 ? running : profile_step(deceleration);
  interpolation_.abandon();
  profile_.brake(step_);
  motion_ = Motion::Profile;
}

void MotionControl::stop_at(std::int64_t counts) {
  interpolation_.abandon();
  profile_.place(counts);
  end();
}

void MotionControl::freeze() {
  interpolation_.abandon();
  profile_.brake(0);
  if (active()) end();
}

void MotionControl::tick() {
  switch (motion_) {
    case Motion::None:
      return limits_.hold();
    case Motion::Interpolated:
      interpolation_.tick();
      if (!interpolation_.active()) end();
      return;
    case Motion::Profile:
      profile_.tick();
      if (profile_.done()) end();
      return;
  }
}

void MotionControl::end() {
  motion_ = Motion::None;
  limits_.begin_holding();
  status_.raise(polling_bit::kDone);
}

std::int64_t MotionControl::profile_step(std::int64_t acceleration) const {
  return profile_.scale().step(acceleration, acceleration_full_scale_);
}

}  // namespace interpolated_motion::emulation
