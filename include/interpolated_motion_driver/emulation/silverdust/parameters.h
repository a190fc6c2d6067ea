#pragma once

#include <cstdint>

#include "interpolated_motion_driver/units/time.h"

/// Settings of an emulated SilverDust drive. "Doc" below is QuickSilver's "Interpolated Motion" (QCI-TD044).
/// The vendor's Command Reference is not public as a whole: what no document says is a parameter here, so
/// that a driver can be tried against every answer.
namespace interpolated_motion::emulation {

/// What becomes of a packet whose numbers are impossible (a register that does not exist, a negative time).
enum class BadValueReply {
  Nak,           ///< NAK 5 (bad format)
  CommandError,  ///< ACK, nothing is done, and bit 12 (command error) of the polling status word is set
};

/// What becomes of a command that starts a motion while the driver is disabled.
enum class DisabledStartReply {
  CommandError,  ///< ACK, no motion, bit 12 of the polling status word
  Busy,          ///< NAK 2 (device busy)
};

/// What becomes of a write to a register in which IMS keeps the segment that it executes (18 and 20..23).
/// Doc: "Any use of these registers while in an IMS operation could cause a program or movement error."
enum class SegmentWriteReply {
  Moves,         ///< the operation goes on with what has been written: a movement error
  CommandError,  ///< ACK, nothing is done, and bit 12 of the polling status word: a program error
};

/// What the documents leave open, each answer is explained at its type.
struct SilverDustReplies {
  BadValueReply bad_values = BadValueReply::Nak;
  DisabledStartReply disabled_start = DisabledStartReply::CommandError;
  SegmentWriteReply segment_writes = SegmentWriteReply::Moves;
  /// Register 0 during an IMS operation is the demand of the tick; false: the segment's position (register
  /// 20). Not documented.
  bool target_in_motion = true;
};

/// By which velocity the target advances in a servo tick in which the profile generator's velocity ramps. The
/// worked example of Doc ends at the same count with all three and reaches its inner marks with MeanVelocity;
/// the others are up to half a tick of travel before or behind them (8 counts of 72000).
enum class Integration {
  MeanVelocity,   ///< the mean of the old and the new velocity, as constant acceleration makes it
  VelocityFirst,  ///< the new velocity
  PositionFirst,  ///< the old velocity
};

/// Acceleration per tick in velocity units, where the scales do not make it whole (IMS: acceleration / 2).
enum class AccelerationRounding {
  Truncated,  ///< towards zero: an integer drive
  Exact,      ///< fractions of a velocity unit are kept
};

/// The axis behind the drive and what stands for its electronics.
struct SilverDustPlant {
  double lag_ticks = 10.0;  ///< servo ticks, >= 0: time constant with which the axis follows; 0: exactly
};

/// All settings of an emulated drive. Defaults are a SilverDust of revision 06 or later with a 1000-line
/// encoder, as delivered.
struct SilverDustParameters {
  int address = 16;  ///< 1..254: unit identity (factory default 16)
  int group = 0;     ///< 1..254: a second address the drive obeys without answering; 0: none

  std::uint16_t revision = 31;  ///< word answered to RVN; its form is not documented
  int queue_depth = 8;          ///< segments waiting in the IMS queue; Doc: 4, and 8 from revision 06; 1..64
  bool multi_register_read = true;  ///< RRG takes 2..4 registers (revision 31 and later), else NAK 5

  int counts_per_revolution = 4000;    ///< counts, 1..1'000'000
  int velocity_full_scale_rpm = 4000;  ///< rpm of 2^31 velocity units, 1..100'000
  int ims_acceleration_full_scale =
      2000;                            ///< rpm per tick of 2^31, in IMS (Doc) and of register 19; 1..100'000
  int acceleration_full_scale = 4000;  ///< the same for MAV, MRV, VMI and STP
  HostDuration tick = std::chrono::microseconds(120);  ///< servo cycle, 10..1000 us
  double clock_error_ppm = 0.0;                        ///< > 0: the drive's crystal is fast; |ppm| <= 100000
  HostDuration tick_phase{0};  ///< of the drive's ticks against its power-up, 0 .. tick
  Integration integration = Integration::MeanVelocity;  ///< not documented, see the type
  /// Not documented, see the type.
  AccelerationRounding acceleration_rounding = AccelerationRounding::Truncated;

  int ims_arguments = -1;  ///< numbers IMS must come with; 0, 2, or -1 for both. Not documented
  int ack_delay = 0;       ///< ticks an answer waits, as ADL sets it (416: 50 ms); 0..65535
  HostDuration turnaround = std::chrono::milliseconds(1);  ///< from a CR to the answer's first bit, without
                                                           ///< the ACK delay; >= 0
  std::uint16_t por_echo = 0;  ///< command number in the answer to POR; the vendor's example shows 0000
  SilverDustReplies replies;   ///< to what cannot be done, or should not
  bool done_bit_of_short_commands = true;  ///< bit 13 of the polling status word is set by each program class
                                           ///< command that is done, not by motions only
  bool immediate_done_bit = false;  ///< bit 15 is set by immediate commands other than POL, POR and CPL

  bool enabled_at_power_up = true;                   ///< the motor driver is on without an EMD
  HostDuration boot_time = std::chrono::seconds(1);  ///< deaf after power-up and RST, >= 0
  bool awake_at_start = true;           ///< the first power-up lies in the past: the drive answers at once
  std::int32_t initial_position = 0;    ///< counts, at the start; 0 after each later power-up and RST
  int moving_error_limit = 20'000;      ///< counts, 1..32767: |target - actual| in motion, until ERL sets it
  int holding_error_limit = 20'000;     ///< the same at rest
  int holding_delay = 120;              ///< ticks after a motion before the holding limit counts, 0..65535
  std::uint16_t status_inputs = 0b111;  ///< inputs 1..3 as the internal status word shows them
  std::uint16_t io_inputs = 0;          ///< the same as the I/O word shows them (bits 0..2 inputs 1..3)
  SilverDustPlant plant;                ///< how the axis follows the target
};

/// Throws std::invalid_argument naming address, parameter, value and allowed range when a setting is out of
/// its range, or when the scales together cannot be computed exactly in 64 bits.
void validate(const SilverDustParameters& parameters);

}  // namespace interpolated_motion::emulation
