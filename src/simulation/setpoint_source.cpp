#include "simulation/setpoint_source.h"

#include <algorithm>
#include <cmath>

#include "simulation/random.h"

namespace interpolated_motion::simulation {

namespace {

constexpr double kPi = 3.14159265358979324;

/// Share of a limit that the sine may use.
constexpr double kShare = 0.5;

/// Amplitude within the limits of a joint, towards the middle of its range.
double amplitude(const Joint& joint, double reach, double omega, double start) {
  const double most = std::min(joint.max_velocity / omega, joint.max_acceleration / (omega * omega));
  const double middle = 0.5 * (joint.min_position + joint.max_position);
  const double size = std::min(reach, kShare * most);
  return start > middle ? -size : size;
}

motion::Setpoint setpoint_at(const Event& event, const Arm& arm, const std::vector<double>& present,
                             double time) {
  const double omega = 2.0 * kPi * std::max(0.01, event.number("hertz", 0.5));
  motion::Setpoint setpoint;
  setpoint.source = "/simulation";
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const double a = amplitude(arm.joints[j], event.number("reach", 0.1), omega, present[j]);
    setpoint.joint_names.push_back(arm.joints[j].name);
    setpoint.positions.push_back(present[j] + a * (1.0 - std::cos(omega * time)));
    if (event.number("velocities") != 0.0) setpoint.velocities.push_back(a * omega * std::sin(omega * time));
  }
  return setpoint;
}

}  // namespace

std::deque<SentSetpoint> make_stream(const Event& event, const Arm& arm, const std::vector<double>& present,
                                     HostTime now) {
  Random random(static_cast<std::uint64_t>(event.number("noise", 1.0)));
  const double period = std::max(0.005, event.number("period", 0.02));
  const int count = static_cast<int>(event.number("for", 1.0) / period);
  std::deque<SentSetpoint> sent;
  for (int k = 0; k < count; ++k) {
    const bool is_lost = random.chance(event.number("loss"));
    const double late = random.number(0.0, 1.0) * event.number("late");
    if (is_lost) continue;
    SentSetpoint one{now + host_duration(k * period + late), setpoint_at(event, arm, present, k * period)};
    one.setpoint.time = now + host_duration(k * period);
    sent.push_back(std::move(one));
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const SentSetpoint& a, const SentSetpoint& b) { return a.arrives < b.arrives; });
  return sent;
}

}  // namespace interpolated_motion::simulation
