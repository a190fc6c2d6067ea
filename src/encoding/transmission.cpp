#include "interpolated_motion_driver/encoding/transmission.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace interpolated_motion::encoding {

namespace {
constexpr double kTwoPi = 6.283185307179586476925286766559;
constexpr double kSecondsPerMinute = 60.0;
}  // namespace

double Transmission::ratio_of_travel(double travel) { return kTwoPi / travel; }

double Transmission::counts_per_radian() const { return direction * ratio * counts_per_revolution / kTwoPi; }

double Transmission::counts(double joint_position) const {
  return (joint_position - offset) * counts_per_radian();
}

std::int32_t Transmission::nearest_counts(double joint_position) const {
  constexpr double kFirst = std::numeric_limits<std::int32_t>::min();
  constexpr double kLast = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::lround(std::clamp(counts(joint_position), kFirst, kLast)));
}

double Transmission::joint_position(double counts) const { return offset + counts / counts_per_radian(); }

double Transmission::joint_velocity(double counts_per_second) const {
  return counts_per_second / counts_per_radian();
}

double Transmission::counts_per_second(double joint_velocity) const {
  return joint_velocity * counts_per_radian();
}

double Transmission::motor_rpm(double joint_velocity) const {
  return counts_per_second(joint_velocity) / counts_per_revolution * kSecondsPerMinute;
}

double Transmission::joint_velocity_from_rpm(double rpm) const {
  return joint_velocity(rpm / kSecondsPerMinute * counts_per_revolution);
}

}  // namespace interpolated_motion::encoding
