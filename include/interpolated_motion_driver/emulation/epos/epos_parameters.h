#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/emulation/plant_parameters.h"
#include "interpolated_motion_driver/units/time.h"

/// Settings of an emulated EPOS drive. What the documents leave open is a parameter here, so that a driver
/// can be tried against every answer. "Doc" below is "EPOS3 Interpolated Position Mode" (the mode is the same
/// on EPOS2).
namespace interpolated_motion::emulation {

/// Which drive is emulated.
enum class EposVariant {
  Epos2,  ///< with Interpolated Position Mode
  Epos4,  ///< without it: the objects 0x20C1, 0x20C4, 0x60C0 and 0x60C4 do not exist and mode 7 is refused
};

/// What becomes of an interpolation data record that arrives at a wrong moment. The documents do not say.
enum class RecordPolicy {
  Accept,  ///< it goes into the buffer
  Drop,    ///< it vanishes; an SDO write is answered as if it had been taken
  Abort,   ///< as Drop, but an SDO write is aborted with 0x08000022 (wrong device state)
};

/// A record for a full buffer while the interpolation is inactive. (While active it is an error: Doc table
/// 4-35, bit 9.)
enum class InactiveOverflow {
  Fault,     ///< as while active: error bit, EMCY 0xFF0C and fault reaction
  ErrorBit,  ///< bit 9 of 0x20C4:1 only
  Drop,      ///< nothing is reported
};

/// A record with time 0 as the first one of a motion. The documents do not say whether it is legal.
enum class LeadingTerminator {
  EndsMode,  ///< the interpolation becomes active and ends at once without an error
  Skipped,   ///< it is removed and the next record is taken
  Fault,     ///< underflow error
};

/// How "in the Interpolation active state at least two data records have to be in the FIFO" (Doc 4.3.6.1) is
/// meant.
enum class UnderflowTest {
  EverySample,   ///< as it is written: at each sample; a queued record with time 0, which ends the mode
                 ///< without an error, lifts the rule
  AtSegmentEnd,  ///< leniently: when a record has been reached and, counting it, fewer than two are left and
                 ///< none ends the mode, so that all records are played first
};

/// When a record leaves the buffer, as 0x60C4:2 and :4 count it.
enum class RecordRelease {
  AtSegmentEnd,    ///< when the drive has reached it
  AtSegmentStart,  ///< when the drive sets out for it
};

/// Controlword 0x1F while fewer than two records are in the buffer.
enum class ShortStart { Fault, Ignore };

/// When the software position limits 0x607D are tested.
enum class PositionLimitCheck {
  RunTime,   ///< on the position demand of each sample
  PerRecord  ///< on the position of each record when it arrives
};

/// At which instants velocity and acceleration of the interpolation are held against their limits.
enum class MotionCheck { Samples, Knots };

/// When the error bits 8..11 of 0x20C4:1 are cleared.
enum class ErrorBitsClear { AtFaultReset, AtBufferClear };

/// What clearing the halt bit does while bit 4 (enable ip mode) is still set.
enum class HaltRelease {
  Resume,  ///< a segment of the interrupted record's full time leads from the present demand, at rest, to
           ///< that record
  NeedsNewStart,  ///< halt ended the mode: bit 4 has to go to 0 and to 1 again
};

/// What happens when bit 4 is cleared or another mode is selected in the middle of a motion.
enum class ActiveStop { ProfileDeceleration, AtOnce };

/// All settings of an emulated drive. Defaults are an EPOS2 70/10 with firmware 0x2126 as delivered.
struct EposParameters {
  EposVariant variant = EposVariant::Epos2;  ///< decides which objects there are

  std::uint8_t node_id = 1;                    ///< 1..127
  std::uint32_t vendor_id = 0x000000FB;        ///< 0x1018:1; EDS: VendorNumber of maxon motor
  std::uint32_t product_code = 0x64200000;     ///< 0x1018:2; EDS: hardware version << 16
  std::uint32_t revision_number = 0x21260000;  ///< 0x1018:3; EDS: firmware version << 16
  std::uint32_t serial_number = 1;             ///< 0x1018:4
  std::string device_name = "EPOS2";           ///< 0x1008, at most 32 characters

  double clock_error_ppm = 0.0;  ///< > 0: the drive's crystal is fast; |ppm| <= 100000
  bool clock_discipline = true;  ///< the motion clock follows SYNC and 0x1013
  HostDuration clock_slew = std::chrono::microseconds(1);  ///< most by which a sample is made shorter or
                                                           ///< longer for that, 1 ns .. 0.5 ms
  HostDuration tick_phase{0};                   ///< of the drive's samples against its power-up, 0 .. 1 ms
  HostDuration boot_time = host_duration(0.2);  ///< from power-up or reset to the boot-up message; >= 1 ms
  HostDuration sdo_response_time = host_duration(0.0003);  ///< from request to response; >= 0

  std::int32_t counts_per_revolution = 2000;  ///< qc per turn of the motor (4 x encoder pulses), > 0
  std::int32_t initial_position = 0;          ///< qc, at the first power-up
  bool position_survives_power_off =
      true;               ///< false: the position is 0 after each power-up (incremental encoder)
  bool homed = false;     ///< bit 15 of the statusword
  PlantParameters plant;  ///< how the axis follows the demand

  std::int16_t abort_connection_option =
      1;  ///< default of 0x6007: 0 nothing, 1 fault, 2 disable voltage, 3 quick stop
  std::int16_t fault_reaction_option =
      2;  ///< default of 0x605E: 0 disable, 1 profile ramp, 2 quick-stop ramp
  std::uint8_t interpolation_error_register = 0x20;  ///< bits added to 0x1001 with EMCY 0xFF0C; 0x20 or 0x80
  std::uint8_t motion_error_register = 0x80;         ///< the same with 0x8611 and 0xFF09 (EPOS4 table)
  std::uint8_t communication_error_register = 0x10;  ///< the same with 0x8130 and 0x8210 (EPOS4 table)
  bool pre_operational_on_heartbeat_loss =
      false;  ///< object 0x1029 does not exist on EPOS2, so its default is unknown
  bool pdo_setup_only_pre_operational =
      true;  ///< PDO parameters written in Operational are aborted with 0x0F00FFC0

  std::int8_t lowest_velocity_notation = -3;  ///< 0x608B takes lowest..0 (0 = rpm, -1 = 0.1 rpm, ...)
  /// The range of 0x607F (EDS: 0..25000) is one in rpm; false: it is one of the bare number, whatever the
  /// unit.
  bool limit_ranges_scale_with_notation = false;
  bool limits_scale_with_notation = true;  ///< 0x6081, 0x607F, 0x606B and 0x606C are in the unit of 0x608B

  bool free_records_pdo_mappable = true;  ///< 0x60C4:2; Doc: yes, EDS: no, real robots map it
  bool time_stamp_pdo_mappable = true;    ///< 0x1013; Doc of EPOS2 and EDS: yes
  bool buffer_clear_pdo_mappable = true;  ///< 0x60C4:6; Doc: no, EDS: yes

  RecordPolicy records_while_access_disabled = RecordPolicy::Abort;  ///< 0x60C4:6 is 0
  RecordPolicy records_outside_mode = RecordPolicy::Abort;           ///< another mode than 7 selected
  RecordPolicy records_outside_operation_enabled =
      RecordPolicy::Accept;  ///< mode 7, but not Operation enable
  /// Each answers a question that Doc leaves open; the answers are explained at their types.
  InactiveOverflow overflow_while_inactive = InactiveOverflow::Fault;
  LeadingTerminator leading_terminator = LeadingTerminator::EndsMode;
  UnderflowTest underflow_test = UnderflowTest::EverySample;
  RecordRelease record_release = RecordRelease::AtSegmentEnd;
  ShortStart short_start = ShortStart::Fault;
  PositionLimitCheck position_limit_check = PositionLimitCheck::RunTime;
  MotionCheck motion_check = MotionCheck::Samples;
  bool motion_warnings_latched = true;        ///< bits 2 and 3 of 0x20C4:1 stay until the buffer is cleared
  bool fill_warnings_while_disabled = false;  ///< bits 0 and 1 of 0x20C4:1 while access is disabled
  /// The same about errors and stopping.
  ErrorBitsClear error_bits_clear = ErrorBitsClear::AtFaultReset;
  HaltRelease halt_release = HaltRelease::Resume;
  ActiveStop active_stop = ActiveStop::ProfileDeceleration;
};

/// Throws std::invalid_argument naming node, parameter, value and allowed range when a setting is out of its
/// range.
void validate(const EposParameters& parameters);

}  // namespace interpolated_motion::emulation
