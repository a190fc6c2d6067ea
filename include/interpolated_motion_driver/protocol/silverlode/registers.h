#pragma once

#include <cstdint>

namespace interpolated_motion::silverlode {

/// Numbers of the dedicated registers, 32 bits each.
namespace registers {
inline constexpr std::uint16_t kTargetPosition = 0;  ///< counts
inline constexpr std::uint16_t kActualPosition = 1;  ///< counts
inline constexpr std::uint16_t kPositionError = 6;   ///< counts, signed in the low word, see `position_error`
inline constexpr std::uint16_t kImsControl = 17;     ///< see `ImsControl`
inline constexpr std::uint16_t kImsTicksLeft = 18;  ///< servo ticks of the running segment; not to be written
inline constexpr std::uint16_t kImsDeceleration = 19;      ///< when the queue runs empty
inline constexpr std::uint16_t kProfilePosition = 20;      ///< counts; 20..23 are overwritten by each segment
inline constexpr std::uint16_t kProfileAcceleration = 21;  ///< units of acceleration
inline constexpr std::uint16_t kProfileVelocity = 22;      ///< units of velocity
inline constexpr std::uint16_t kProfileDeceleration = 23;  ///< units of acceleration
inline constexpr std::uint16_t kProfileOffset = 24;        ///< of PMC
}  // namespace registers

/// The two words of a register.
inline constexpr std::uint16_t high_word(std::int32_t value) {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(value) >> 16);
}
inline constexpr std::uint16_t low_word(std::int32_t value) {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(value) & 0xFFFFu);
}
/// A register from the two words of a reply, high word first.
inline constexpr std::int32_t register_value(std::uint16_t high, std::uint16_t low) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(high) << 16 | low);
}
/// Position error in counts from register 6. Its high word is another number.
inline constexpr std::int16_t position_error(std::int32_t value) {
  return static_cast<std::int16_t>(low_word(value));
}

/// Register 17 (QCI-TD044, "Registers Used with Interpolated Motion").
struct ImsControl {
  /// Register based queue: the segment has been copied, the registers may be filled anew.
  bool segment_used = false;
  /// First of the four registers with the next segment; 0: the queue of IMW is used.
  std::uint16_t first_register = 0;
};
/// Register 17 read and to be written.
constexpr ImsControl decode_ims_control(std::int32_t value) {
  return {high_word(value) != 0, low_word(value)};
}
constexpr std::int32_t encode_ims_control(ImsControl control) {
  return register_value(control.segment_used ? 1 : 0, control.first_register);
}

/// What the units of a drive mean. Full scale is 2^31.
struct DriveScale {
  double counts_per_revolution = 4000;    ///< of the encoder on the motor
  double tick = 120e-6;                   ///< s
  double velocity_full_scale_rpm = 4000;  ///< rpm of the motor at 2^31
  /// Of ordinary commands (STP): 1 unit is 1 unit of velocity a tick.
  double acceleration_full_scale_rpm_per_tick = 4000;
  /// Of IMS segments and register 19: QCI-TD044 says 2000.
  double ims_acceleration_full_scale_rpm_per_tick = 2000;
};

/// Units of velocity nearest to `counts_per_second`, a magnitude; within 0..2^31-1.
std::int32_t velocity_units(double counts_per_second, const DriveScale& scale);
/// Units of acceleration of ordinary commands nearest to `counts_per_second2`, within 1..2^30.
std::int32_t acceleration_units(double counts_per_second2, const DriveScale& scale);
/// Units of acceleration of IMS nearest to `counts_per_second2`, within 1..2^30.
std::int32_t ims_acceleration_units(double counts_per_second2, const DriveScale& scale);
/// The other way round, in counts/s and counts/s^2.
double velocity_of_units(std::int32_t units, const DriveScale& scale);
double acceleration_of_units(std::int32_t units, const DriveScale& scale);
double ims_acceleration_of_units(std::int32_t units, const DriveScale& scale);

}  // namespace interpolated_motion::silverlode
