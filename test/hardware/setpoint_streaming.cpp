#include "hardware/setpoint_streaming.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::test {

namespace {

constexpr double kPi = 3.14159265358979324;
constexpr double kCountsPerRadian = 200000.0 / (2.0 * kPi);  // of every drive in scenario.h
/// Samples further apart than this belong to different motions, s.
constexpr double kGap = 0.005;

}  // namespace

void SetpointStreaming::start(const YAML::Node& parameters, double delay) {
  delay_ = delay;
  scenario.emplace(parameters);
  ASSERT_TRUE(scenario->run_until_state(motion::GroupState::Idle)) << scenario->snapshot().fault;
  const std::size_t joints = scenario->snapshot().joints.size();
  smoothness.assign(joints, {});
  tracks_.assign(joints, {});
  scenario->driver().set_sample_observer(
      [this](std::size_t joint, const hardware::DemandSample& sample) { watch(joint, sample); });
}

double SetpointStreaming::position_at(double time) { return kAmplitude * (1.0 - std::cos(2.0 * kPi * time)); }

double SetpointStreaming::velocity_at(double time) {
  return kAmplitude * 2.0 * kPi * std::sin(2.0 * kPi * time);
}

motion::Setpoint SetpointStreaming::setpoint(HostTime time, double position) {
  motion::Setpoint s;
  s.time = time;
  s.source = "/joystick";
  for (int i = 1; i <= 6; ++i) {
    s.joint_names.push_back(fmt::format("joint{}", i));
    s.positions.push_back(position);
  }
  return s;
}

std::optional<Refusal> SetpointStreaming::send(const motion::Setpoint& s) {
  return scenario->driver().setpoint(s, scenario->now());
}

void SetpointStreaming::stream(double duration, const std::function<double(int)>& arrives) {
  begin = scenario->now();
  streaming_ = true;
  const int count = static_cast<int>(std::lround(duration / kPeriod));
  std::vector<std::pair<double, int>> order;
  for (int k = 0; k < count; ++k) {
    const double late = arrives(k);
    if (late >= 0.0) order.emplace_back(k * kPeriod + late, k);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [when, k] : order) {
    run_to(begin + host_duration(when));
    const auto refusal = send(setpoint(begin + host_duration(k * kPeriod), position_at(k * kPeriod)));
    if (!refusal) continue;
    ++refused;
    ADD_FAILURE() << "setpoint " << k << ": " << refusal->text;
  }
  streaming_ = false;
}

std::function<double(int)> SetpointStreaming::with_loss(double lost, unsigned seed) {
  return [lost, random = std::mt19937(seed)](int k) mutable {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const bool is_lost = k > 5 && unit(random) < lost;
    const double late = unit(random) * kPeriod / 2.0;
    return is_lost ? -1.0 : late;
  };
}

void SetpointStreaming::run(double duration) { run_to(scenario->now() + host_duration(duration)); }

void SetpointStreaming::run_to(HostTime when) {
  while (scenario->now() < when) {
    scenario->run(std::min(0.001, seconds(when - scenario->now())));
    look();
  }
}

void SetpointStreaming::watch(std::size_t joint, const hardware::DemandSample& sample) {
  Track& track = tracks_[joint];
  Smoothness& seen = smoothness[joint];
  const double position = sample.demand / kCountsPerRadian;
  const double passed = sample.drive_seconds - track.time;
  std::optional<double> velocity;
  if (track.time >= 0.0 && passed > 0.0 && passed < kGap) velocity = (position - track.position) / passed;
  if (velocity && track.velocity) {
    const double step = std::abs(*velocity - *track.velocity);
    seen.velocity_step = std::max(seen.velocity_step, step);
    seen.acceleration = std::max(seen.acceleration, step / passed);
  }
  const double sine = std::abs(velocity_at(seconds(sample.time - begin) - delay_));
  const bool fast = sine > 0.9 * kAmplitude * 2.0 * kPi && sample.time > begin + host_duration(1.0);
  if (velocity && streaming_ && fast) seen.slowest = std::min(seen.slowest, std::abs(*velocity));
  track = {sample.drive_seconds, position, velocity};
}

}  // namespace interpolated_motion::test
