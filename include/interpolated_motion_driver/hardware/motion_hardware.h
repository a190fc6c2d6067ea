#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/bus_device.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/demand_sample.h"
#include "interpolated_motion_driver/hardware/event_log.h"
#include "interpolated_motion_driver/hardware/goal_desk.h"
#include "interpolated_motion_driver/hardware/wire_observer.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/motion/speed_control.h"
#include "interpolated_motion_driver/recording/recording.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// A named joint as ros_control hands it out: pointers that stay valid as long as the hardware lives.
struct JointHandle {
  std::string name;
  const double* position = nullptr;    ///< rad or m, actual, as of the last read()
  const double* velocity = nullptr;    ///< per s, the same
  const double* demand = nullptr;      ///< rad or m, the drive's demand, the same
  double* position_command = nullptr;  ///< rad, for write(); NaN, as at first: none
};

/// The whole driver below ROS: buses, axes and the motion group of one configuration, with emulated drives
/// where the configuration asks for them. Not thread-safe: one thread owns it. Nothing blocks and no clock is
/// read; it lives on the times it is given, so it runs in virtual time as well as in real time.
///
/// Typical loop: `update(now)`, take results, sleep until `next_deadline()` (at most a few ms) or until
/// EventLoop::wake is called, again.
class MotionHardware {
 public:
  /// Composes everything; drives are looked for from `now` on. `loop` is needed for buses that are not
  /// emulated; an interface or a port that is not there is no error, it may come. Throws
  /// std::invalid_argument.
  MotionHardware(const Configuration& configuration, HostTime now, EventLoop loop = {});
  ~MotionHardware();
  MotionHardware(const MotionHardware&) = delete;
  MotionHardware& operator=(const MotionHardware&) = delete;

  /// As hardware_interface::RobotHW: takes everything that has happened on the buses until `now`, and sets
  /// position, velocity and demand of the handles.
  void read(HostTime now, HostDuration period);
  /// As hardware_interface::RobotHW: takes the position commands of the handles as a setpoint of `now`, at
  /// most once in `setpoints/write_period`, then sends what is due. Nothing is commanded while every command
  /// is NaN. The commands are followed as any stream of setpoints; returned is why they are not.
  std::optional<Refusal> write(HostTime now, HostDuration period);
  /// For a loop that needs no handles: takes what has happened until `now`, and sends what is due. With
  /// emulated buses everything since the last call happens at its own time.
  void update(HostTime now);
  /// For tests: a host that is not there. Emulated buses and drives go on until `until` while nobody polls
  /// the driver; without emulated buses nothing happens.
  void stall(HostTime until);
  /// When update() should be called next at the latest.
  HostTime next_deadline() const;

  const std::vector<JointHandle>& joints() const;

  /// Takes a goal, or says why not. Replaces the goal that is under way, which then ends as Preempted. A goal
  /// without points and with the right joints is a stop. Never called from within update(). The goal is
  /// planned before the function returns, which takes the time that it takes.
  Expected<motion::GoalAcceptance, Refusal> submit(const trajectory::Goal& goal, HostTime now);

  /// As submit(), for goals that are planned while the drives go on, by the planner: the answer comes later,
  /// see take_goal_answer(). Of goals that wait for another one's planning the newest counts. Not to be mixed
  /// with submit().
  Ticket submit_later(motion::GoalPtr goal, HostTime now);
  /// A goal that has not been answered yet is refused; without effect for any other.
  void withdraw(Ticket ticket, HostTime now);
  /// The next goal that has been accepted or refused, oldest first; every one of submit_later() once.
  std::optional<GoalAnswer> take_goal_answer();
  /// Who plans the goals of submit_later(), and those that have waited for rest; to be set before the first
  /// one. Without a planner they are planned on the spot.
  void set_planner(Planner planner);
  /// The planner has run `planning`, which took it so long.
  void planned(const motion::Planning& planning, HostDuration taken, HostTime now);
  /// For tests, without a planner: planning takes so long.
  void set_planning_time(HostDuration time);

  /// Stops the goal, if it is still under way; it ends as Preempted.
  void cancel(motion::GoalId goal, HostTime now);
  /// The next goal that has ended, oldest first.
  std::optional<motion::GoalResult> take_goal_result();

  /// From now on goals are gone along so fast, the one under way too; a pause where that is 0. Or why not.
  /// What becomes of it is in the snapshot, and what the limits do not allow in the log.
  std::optional<Refusal> order_speed(const motion::SpeedOrder& order, HostTime now);

  /// Takes a setpoint of a stream, or says why not: the arm follows the stream a fixed delay behind it, and
  /// comes to rest within its limits when the stream ends. A goal replaces a stream as it replaces a goal.
  std::optional<Refusal> setpoint(const motion::Setpoint& setpoint, HostTime now);

  /// Requests take time; each ends with one RequestResult.
  motion::RequestId enable(bool on, HostTime now);
  motion::RequestId shut_down(HostTime now);  ///< as enable(false), for the driver's end
  motion::RequestId reset_faults(HostTime now);
  motion::RequestId halt(HostTime now);           ///< stops the group at once by the drives' own deceleration
  motion::RequestId clear_buffers(HostTime now);  ///< stops the group, then empties every FIFO
  std::optional<motion::RequestResult> take_request_result();

  /// A consistent view of everything published, as of the last update(). `out` is reused to avoid allocation.
  void snapshot(motion::Snapshot& out) const;
  /// Figures of the last goal that moved.
  motion::MotionReport report() const;
  /// The committed trajectory at `time`, per joint; before it, what was desired then, as far back as a
  /// minute. False where neither is known.
  bool query(HostTime time, std::vector<trajectory::State>& out) const;

  /// Text for the log that arose since the last call: severity and sentence.
  using Severity = hardware::Severity;
  using LogEntry = hardware::LogEntry;
  std::optional<LogEntry> take_log();

  /// `observer` sees everything that crosses any bus from now on.
  void set_wire_observer(WireObserver observer);

  /// A copy of what the flight recorder has: the last seconds of everything, up to the last update().
  recording::Recording recording() const;

  /// Samples of a drive that another program emulates, for the report of the last goal: forgets those there
  /// are, takes one more. `joint` is a number in joints(). For tests and demonstrations.
  void forget_samples(std::size_t joint);
  void add_sample(std::size_t joint, const DemandSample& sample);

  /// `observer` is called at each sample of an emulated drive that interpolates a goal or a stream, with the
  /// number of its joint in joints().
  void set_sample_observer(SampleObserver observer);
  /// `observer` is called at each sample of an emulated drive while it is powered: at rest, in stops and in
  /// faults as well. A drive at rest may leave out samples in which nothing changes.
  void set_motion_observer(SampleObserver observer);

  /// Where the emulated drive of a joint stands, rad, as of the last update(), whether or not its bus tells;
  /// nothing if it is not emulated in this process. `joint` is a number in joints().
  std::optional<double> emulated_position(std::size_t joint) const;
  /// Whether the motor of the joint's emulated drive has power, in the same way.
  std::optional<bool> emulated_power(std::size_t joint) const;

  /// Injects a fault into the emulated drive of a joint or into an emulated bus, see emulation/drive.h and
  /// emulation/bus_faults.h. False
  /// with a reason when `target` is not emulated or the command is unknown.
  bool inject(const std::string& target, const std::string& command, std::string* reason, HostTime now);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::hardware
