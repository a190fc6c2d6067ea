#include "interpolated_motion_driver/protocol/silverlode/registers.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::silverlode {
namespace {

constexpr double kFullScale = 2147483648.0;  ///< 2^31
constexpr double kMaxVelocity = 2147483647.0;
constexpr double kMaxAcceleration = 1073741824.0;  ///< 2^30, of every command that takes an acceleration

std::int32_t rounded(double units, double low, double high) {
  return static_cast<std::int32_t>(std::llround(std::clamp(units, low, high)));
}

/// Units of velocity per count/s.
double velocity_factor(const DriveScale& scale) {
  return 60 / scale.counts_per_revolution / scale.velocity_full_scale_rpm * kFullScale;
}

/// Units of acceleration per count/s^2 for a full scale in rpm per tick.
double acceleration_factor(const DriveScale& scale, double full_scale) {
  return 60 * scale.tick / scale.counts_per_revolution / full_scale * kFullScale;
}

}  // namespace

std::int32_t velocity_units(double counts_per_second, const DriveScale& scale) {
  return rounded(std::abs(counts_per_second) * velocity_factor(scale), 0, kMaxVelocity);
}

std::int32_t acceleration_units(double counts_per_second2, const DriveScale& scale) {
  const double factor = acceleration_factor(scale, scale.acceleration_full_scale_rpm_per_tick);
  return rounded(std::abs(counts_per_second2) * factor, 1, kMaxAcceleration);
}

std::int32_t ims_acceleration_units(double counts_per_second2, const DriveScale& scale) {
  const double factor = acceleration_factor(scale, scale.ims_acceleration_full_scale_rpm_per_tick);
  return rounded(std::abs(counts_per_second2) * factor, 1, kMaxAcceleration);
}

double velocity_of_units(std::int32_t units, const DriveScale& scale) {
  return units / velocity_factor(scale);
}

double acceleration_of_units(std::int32_t units, const DriveScale& scale) {
  return units / acceleration_factor(scale, scale.acceleration_full_scale_rpm_per_tick);
}

double ims_acceleration_of_units(std::int32_t units, const DriveScale& scale) {
  return units / acceleration_factor(scale, scale.ims_acceleration_full_scale_rpm_per_tick);
}

}  // namespace interpolated_motion::silverlode
