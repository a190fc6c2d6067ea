#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/trajectory/joint_unit.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// As axis::AxisStatus: what a drive says of its FIFO and of the records in it.
struct BufferWarnings {
  bool underflow = false;
  bool overflow = false;
  bool velocity = false;
  bool acceleration = false;
};

/// Everything that is published of one joint, at one instant.
struct JointSnapshot {
  std::string joint;  ///< in the order of the configuration, as all joints here
  std::string bus;    ///< as the configuration names it
  trajectory::JointUnit unit = trajectory::JointUnit::Radian;  ///< of all its positions here

  /// The committed trajectory at the drive's estimated play-back time. Of a joint that
  /// brakes by itself, or that no drive holds: what it does.
  trajectory::State desired;
  trajectory::State actual;  ///< as the drive reports; no acceleration

  bool online = false;           ///< the drive answers and its heartbeat arrives
  std::string state;             ///< CiA 402 state, or its SilverLode equal, as text
  std::uint16_t statusword = 0;  ///< CiA 402 statusword 0x6041; of SilverLode the polling status word
  std::int8_t mode = 0;          ///< modes of operation display 0x6061; 0 of SilverLode
  double demand_position = 0.0;  ///< the drive's own demand value
  double following_error = 0.0;  ///< demand minus actual
  std::uint16_t error_code = 0;  ///< last EMCY error code since the last reset, 0 none
  std::string error_text;        ///< what the code means; empty: none

  std::uint32_t capacity = 0;  ///< records the FIFO holds
  std::uint32_t fill = 0;  ///< records in the FIFO, estimated from time and corrected by the drive's reports
  double fill_time = 0.0;  ///< s of motion left in the FIFO
  BufferWarnings warnings;
  std::uint32_t underruns = 0;       ///< since start of the driver
  std::uint32_t overflows = 0;       ///< times the drive has reported one, since start of the driver
  std::uint32_t refused_writes = 0;  ///< records the drive did not take
  std::uint64_t records_sent = 0;    ///< since start of the driver
  double clock_error_ppm = 0.0;  ///< estimated, of the drive's clock against the host's; NaN while unknown
};

/// From a request on a serial line to its reply, s.
struct ReplyDelay {
  double mean = 0.0;     ///< of the latest replies
  double planned = 0.0;  ///< what the line is planned with, `turnaround`
};

struct BusSnapshot {
  std::string name;                   ///< as the configuration names it
  double load = 0.0;                  ///< 0..1, over the last second
  std::uint64_t frames_sent = 0;      ///< frames of this host; on a serial line, requests
  std::uint64_t frames_received = 0;  ///< frames of others; on a serial line, replies
  std::uint64_t unexpected = 0;       ///< frames nobody was waiting for
  bool usable = true;                 ///< frames can travel: the interface is up, the port is open
  std::string state;                  ///< of interface or port, in one sentence with what to do
  std::uint64_t error_frames = 0;     ///< reports of the CAN controller about a disturbed bus
  std::uint64_t lost_frames = 0;      ///< frames the kernel had no room for, and frames never seen on the bus
  double sync_delay = 0.0;          ///< s, from the instant periodic SYNC is due to its end on the bus, mean
  double sync_jitter = 0.0;         ///< s, largest deviation from that in the last seconds
  std::uint64_t syncs_skipped = 0;  ///< not sent, since the host was too late
  std::optional<ReplyDelay> reply_delay;  ///< of a serial line
};

enum class GroupState {
  Starting,  ///< drives are being found and configured
  Disabled,  ///< drives answer, power stages off
  Enabling,
  Idle,       ///< enabled, at rest, ready for a goal
  Preparing,  ///< a goal is being loaded into the drives
  Moving,
  Settling,   ///< the records are played; waiting for the joints to be within their goal tolerances
  Streaming,  ///< follows setpoints
  Standing,   ///< at rest after a goal, the drives still under way for a moment: the next goal joins at once
  Stopping,
  Fault,  ///< a drive is in fault or lost; ~reset_faults, then ~enable
};

/// The name in lower case, such as "preparing".
const char* to_string(GroupState state);

/// How fast goals are gone along.
struct SpeedSnapshot {
  double override_rate = 1.0;  ///< as asked for, 0 .. 2
  bool paused = false;         ///< goals stand still, whatever the override
  double rate = 1.0;  ///< of the active goal at this instant; while nothing moves, what goals begin with
};

/// One consistent view of the whole driver.
struct Snapshot {
  HostTime time{};                          ///< at which all this was so
  GroupState state = GroupState::Starting;  ///< as of `time`
  std::string fault;                        ///< why the group is in Fault; empty otherwise
  GoalId active_goal = 0;                   ///< 0 when none
  /// Of the active goal, as at speed 1, on the play-back clock; time_from_start of `desired`.
  GoalTime goal_time{0.0};
  GoalTime goal_duration{0.0};  ///< of the active goal, without its lead-in
  SpeedSnapshot speed;
  StreamCounters setpoints;           ///< since the driver was started
  std::vector<JointSnapshot> joints;  ///< in the order of the configuration
  std::vector<BusSnapshot> buses;     ///< in the order of the configuration
};

/// Figures of the last goal that moved, for `scripts/demo` and for benches.
struct JointReport {
  std::string joint;                                           ///< in the order of the configuration
  std::string bus;                                             ///< as the configuration names it
  trajectory::JointUnit unit = trajectory::JointUnit::Radian;  ///< of its positions
  double count = 0.0;                ///< rad or m of the joint in one count of its encoder
  std::uint64_t records_sent = 0;    ///< for this goal
  std::uint32_t minimum_fill = 0;    ///< records, while interpolating and more were to come
  std::uint32_t underruns = 0;       ///< during this goal
  std::uint32_t refused_writes = 0;  ///< records the drive did not take at once
  std::uint64_t samples = 0;         ///< drive samples compared (0: the drive is not emulated)
  double worst_deviation =
      0.0;  ///< counts: drive's demand against the goal's polynomial, over all drive samples
  double final_deviation = 0.0;  ///< counts, at the last sample
};

struct MotionReport {
  bool valid = false;                                         ///< false before the first goal has moved
  GoalId goal = 0;                                            ///< 0 for a stream
  GoalTime duration{0.0};                                     ///< its lead-in included; 0 for a stream
  std::vector<JointReport> joints;                            ///< in the order of the configuration
  std::vector<std::pair<std::string, double>> peak_bus_load;  ///< per bus: name, 0..1
};

}  // namespace interpolated_motion::motion
