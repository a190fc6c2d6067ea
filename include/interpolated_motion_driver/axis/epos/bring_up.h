#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/epos/epos_parameters.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"

namespace interpolated_motion::axis {

/// What bring-up, and the first motion after it, have found out about a drive.
struct EposFacts {
  cia402::Identity identity;                      ///< 0x1018:01 to :04
  std::uint32_t capacity = cia402::kFifoRecords;  ///< records, 0x60C4:01
  int velocity_notation = 0;                      ///< 0x608B: the drive's velocity unit is 10^notation rpm
  bool free_records_mapped = true;                ///< 0x60C4:02 comes by TPDO3
  bool takes_time_stamps = false;                 ///< 0x1013 is mapped: its clock follows SYNC
  std::string time_stamp_refusal;                 ///< why it is not, in the drive's words
  std::uint32_t max_velocity = 0;                 ///< velocity units, as written to 0x607F
  std::uint32_t max_acceleration = 0;             ///< rpm/s, as written to 0x60C5
  /// Whether the drive takes a record out of its FIFO when it sets out for it (1) or when it has reached it
  /// (0): the documents do not say; seen from the first report of a motion.
  std::optional<std::size_t> early_release;

  /// rpm of the motor in one velocity unit of a record, 0.001..1.
  double velocity_unit_rpm() const;
};

/// The drive's limits for a joint, in rpm and rpm/s of the motor.
struct MotorLimits {
  double velocity = 0.0;      ///< rpm, a magnitude
  double acceleration = 0.0;  ///< rpm/s, a magnitude
};
/// `parameters.limits` through its transmission; `limit_margin` is not in it.
MotorLimits motor_limits(const EposAxisParameters& parameters);

/// The writes of the drive's own position limits, see position_limits(); the sequence ends where it refuses
/// them.
std::vector<SdoSequence::Step> epos_position_limit_steps(const EposAxisParameters& parameters,
                                                         std::optional<double> present);

/// The reads and writes that identify, verify and parameterise a drive in Pre-operational, in the order of
/// "EPOS2 Interpolated Position Mode" with everything the driver relies on checked before. What is found goes
/// to `facts`, which must outlive the sequence. Every check ends with a sentence that names the object, what
/// was found and what is needed.
std::vector<SdoSequence::Step> epos_bring_up_steps(const EposAxisParameters& parameters, std::uint8_t node,
                                                   SdoSequence& sequence, EposFacts& facts);

}  // namespace interpolated_motion::axis
