#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis_notes.h"
#include "interpolated_motion_driver/axis/bus_watch.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What an axis is doing, the same for every kind of drive. Commands are allowed in the states named beside
/// them.
enum class AxisState {
  Offline,      ///< no answer from the drive: reset_fault() looks for it again
  Configuring,  ///< being found, identified, verified and parameterised
  Disabled,     ///< power stage off: enable()
  Enabling,
  Ready,          ///< enabled, at rest, FIFO empty: load(), disable()
  Loading,        ///< FIFO being emptied, filled and verified
  Loaded,         ///< waits for arm()
  Moving,         ///< the drive plays its FIFO
  Stopping,       ///< brakes by its own deceleration, then empties its FIFO
  FaultStopping,  ///< a fault was found, and the drive may still be moving, or is being switched off: ends in
                  ///< Fault or Offline; disable() of Fault and Offline leads here
  Fault,          ///< the drive is in fault, or it did not do what it was told: reset_fault()
};

/// For messages, in lower case: "stopping with a fault".
const char* to_string(AxisState state);

/// A report of position and velocity by the drive, at the time it was latched.
struct AxisFeedback {
  HostTime time{};        ///< of the latching, on the host's clock; the epoch: no report yet
  double position = 0.0;  ///< rad
  double velocity = 0.0;  ///< rad/s
  /// The velocity is the mean over so much time before `time`; 0: that of the instant.
  HostDuration mean_over{};
};

/// What is published of an axis besides its feedback.
struct AxisStatus {
  bool online = false;  ///< the drive has answered and has not been lost since
  std::string state;    ///< as CiA 402 names it; of SilverLode, which has no such states, the nearest words
  std::uint16_t statusword = 0;  ///< 0x6041; of SilverLode the polling status word (POL)
  std::int8_t mode = 0;          ///< 0x6061; 0 of SilverLode
  double demand_position = 0.0;  ///< rad
  double following_error = 0.0;  ///< rad
  /// Of the last EMCY since the last reset, 0: none; of SilverLode the polling status word while it tells of
  /// a fault.
  std::uint16_t error_code = 0;
  std::string error_text;      ///< the same in words; empty: none
  std::uint32_t capacity = 0;  ///< records
  std::uint32_t fill = 0;      ///< records
  double fill_time = 0.0;      ///< s
  /// EPOS: bits 0 to 3 of 0x20C4:01. SilverLode: underflow while nothing waits behind the segment under
  /// execution and more is to come, the others never. Cyclic: none ever.
  bool underflow_warning = false;
  bool overflow_warning = false;
  bool velocity_warning = false;
  bool acceleration_warning = false;
  /// Since the driver was started. Underruns: times a drive ran dry; of cyclic ones, SYNCs without a target
  /// position. Overflows: times an EPOS has said so (0x20C4:01 bit 9, which stays), whatever the number of
  /// records. Refused: records that were lost or not taken.
  std::uint32_t underruns = 0;
  std::uint32_t overflows = 0;
  std::uint32_t refused_writes = 0;
  std::uint64_t records_sent = 0;
  /// Of the drive's clock, estimated; positive: fast; 0 where it follows the host's, NaN while unknown.
  double clock_error_ppm = 0.0;
};

/// Figures of the plan that was played last.
struct AxisReport {
  std::uint64_t records_sent = 0;  ///< since load(), any that ends the motion included
  std::uint32_t minimum_fill = 0;  ///< records, while moving and more were to come
  std::uint32_t underruns = 0;     ///< of this motion; see AxisStatus
  std::uint32_t refused_writes =
      0;  ///< records the drive did not take at once (EPOS: got lost; SilverLode: NAK)
};

/// What Axis::committed() is when the end of the path can no longer be changed.
inline constexpr GoalTime kEndCommitted{std::numeric_limits<double>::infinity()};

/// For whom a path is played: decides how it is encoded, and how far ahead of the present it is committed.
enum class Pace {
  Goal,    ///< as few records as will do, `commit_horizon` ahead
  Stream,  ///< short records, a tenth of a second ahead: the path is about to change
};

/// One drive as the host sees it: found, verified, enabled, fed and stopped through this interface, whatever
/// its kind. Sans-IO: it is called with the time, and its frames go through the master of its bus. Commands
/// return at once; their progress is seen in state(). A command that fails ends in Fault or Offline with a
/// reason in fault_text().
class Axis {
 public:
  virtual ~Axis() = default;

  /// The joint, and the bus its drive is on, as the configuration names them.
  virtual const std::string& joint() const = 0;
  virtual const std::string& bus() const = 0;
  /// What was found: "Joint joint1 (can0 node 1): maxon EPOS2 70/10, firmware 0x2126, ...".
  virtual std::string description() const = 0;
  /// As of the latest poll() or command.
  virtual AxisState state() const = 0;
  /// Why the axis is Offline, in Fault or FaultStopping, in sentences with joint, bus, node and what to do.
  /// Empty otherwise.
  virtual const std::string& fault_text() const = 0;

  /// Does what is due at `now`.
  virtual void poll(HostTime now) = 0;
  /// When poll() has something to do even if nothing arrives; kNever while only a command or the drive can
  /// change anything.
  virtual HostTime next_deadline() const = 0;

  /// Looks for the drive and forgets what was known of it: Configuring, then Disabled; Offline where none
  /// answers in time, Fault where it is not as it must be. Nothing is stopped before: not for an axis that
  /// may be moving.
  virtual void bring_up(HostTime now) = 0;
  /// Switches the power stage on: Enabling, then Ready. Without effect but in Disabled.
  virtual void enable(HostTime now) = 0;
  /// Switches the power stage off: Stopping, then Disabled. A drive that is Offline or in Fault is told too,
  /// once, since it may be on for all that is known, and keeps its fault: FaultStopping until it has
  /// answered, a second or two at most. Without effect in other states than these and Ready.
  virtual void disable(HostTime now) = 0;
  /// Clears a fault; an axis that was lost is looked for again. Ends in Disabled. Without effect but in Fault
  /// and Offline.
  virtual void reset_fault(HostTime now) = 0;

  /// Where the drive's demand rests, in joint units. Valid in Disabled, Ready.
  virtual double rest_position() const = 0;
  /// How long before the path begins the axis must be told when that is to be. Zero: the axis begins at the
  /// start signal of its bus, and where that falls is known only afterwards.
  virtual GoalTime start_lead() const = 0;
  /// Encodes goals from rest at `rest`, in joint units. An axis that begins at the start signal rests for
  /// `wait` from then on before it sets out; an axis with a lead ignores it. `rest` need not be where the
  /// drive rests now: so whether a goal will be possible from where a motion ends can be asked before.
  virtual TailEncoderPtr encoder_at_rest(double rest, GoalTime wait) const = 0;
  /// Seconds of bus one record takes, as share of the bus that records may fill.
  virtual double record_bus_time() const = 0;
  /// What else it asks of the bus in motion, and what its records really take.
  virtual BusWatch bus_watch() const { return {}; }
  /// Loads a tail from where it rests into the FIFO and verifies that it got there: Loading, then Loaded.
  /// `tail`: by its encoder_at_rest() or its standing_tail().
  virtual void load(TailPtr tail, HostTime now) = 0;
  /// Starts the motion. An axis without a lead puts its start command on the bus, to be obeyed at the next
  /// start signal (EPOS: SYNC), whatever `begin` is. An axis with a lead sees to it that its path begins at
  /// `begin`.
  virtual void arm(HostTime begin, HostTime now) = 0;
  /// When the path begins or began; kNever while that is not known.
  virtual HostTime path_begin() const = 0;
  /// Brakes by the drive's own deceleration and empties the FIFO: Stopping, then Ready. Also ends Loading and
  /// Loaded.
  virtual void stop(HostTime now) = 0;

  // A path that changes while it is played.

  /// A tail for load() whose goal time 0 is at host time `origin` and which is to be changed while it is
  /// played: at first the axis stands, for `rest` from the begin on.
  virtual Expected<TailPtr, Refusal> standing_tail(HostTime origin, GoalTime rest) const = 0;
  /// How far ahead of the present the motion is committed, at most, while a stream is followed.
  virtual GoalTime stream_lead() const = 0;
  /// Until when the path can no longer be changed, in its goal time: infinite once its end is committed;
  /// nothing while the motion has not begun.
  virtual std::optional<GoalTime> committed() const = 0;
  /// Commits to what is played up to `until` at least, so that a tail which is made meanwhile still joins.
  virtual void hold(GoalTime until) = 0;
  /// Encodes ways on behind committed(), for paths that are the present one up to there. Only while
  /// committed() is finite.
  virtual TailEncoderPtr encoder_behind(Pace pace) const = 0;
  /// Tells of a way on behind committed() where the drive would leave the joint's limits with what it makes
  /// of it. None: what the drive plays is within them where the path is.
  virtual trajectory::DemandCheck demand_check() const { return {}; }
  /// Whether committed() is still where `tail` begins, one by its encoder_behind().
  virtual bool can_follow(const Tail& tail) const = 0;
  /// Takes a way on that it can follow. At the end of the path the axis is finished.
  virtual void follow(TailPtr tail) = 0;

  /// Goal time the drive is playing at host time `when` (before the path's start while not started).
  virtual GoalTime playback(HostTime when) const = 0;
  /// Goal time of what the drive plays when `drive_seconds` have passed on its own clock since its motion
  /// began.
  virtual GoalTime goal_time_at(double drive_seconds) const = 0;
  /// True once the drive has played the whole plan and left its interpolation by itself.
  virtual bool finished() const = 0;
  /// Latest position and velocity from the drive.
  virtual const AxisFeedback& feedback() const = 0;
  /// Sets every field of `out`.
  virtual void status(HostTime now, AxisStatus& out) const = 0;
  /// Of the plan loaded last.
  virtual AxisReport report() const = 0;
  /// What has happened to the drive and is to be logged, oldest first; nothing if there is no more.
  virtual std::optional<AxisNote> take_note() { return std::nullopt; }
};

}  // namespace interpolated_motion::axis
