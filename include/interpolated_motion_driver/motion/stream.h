#pragma once

#include <optional>

#include "interpolated_motion_driver/motion/drives.h"
#include "interpolated_motion_driver/motion/group_parameters.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/motion/setpoint_path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A stream of setpoints that the drives follow: set going at rest or behind a goal, each setpoint a way on
/// behind what is committed, to rest behind the last one.
class Stream {
 public:
  /// Both must outlive it.
  Stream(const GroupParameters& parameters, Drives& drives);

  /// Takes a setpoint that has come at `now`, or says why not. Only while the group takes setpoints.
  std::optional<Refusal> take(const Setpoint& setpoint, HostTime now);
  /// One that was refused by others.
  void count_refused() { ++counters_.refused; }
  const StreamCounters& counters() const { return counters_; }

  /// What is due while the drives are streaming.
  void poll(HostTime now);
  /// The drives are at rest: a setpoint that has waited for that begins another stream, or is forgotten.
  void take_waiting(HostTime now);
  void forget_waiting() { waiting_.reset(); }

 private:
  /// How far it has come: loading into the drives, on their way to its begin, following.
  enum class Stage { Loading, Beginning, Following };

  std::optional<Refusal> place(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> open(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> go_on(const Setpoint& setpoint, HostTime now);
  std::optional<Refusal> follow(const Setpoint& setpoint, HostTime now);
  void begin(HostTime now);
  void join(HostTime now);

  Drives& drives_;
  SetpointPath path_;
  Stage stage_ = Stage::Following;
  std::optional<Setpoint> waiting_;  ///< the newest one, until the drives have begun, or are at rest
  StreamCounters counters_;
};

}  // namespace interpolated_motion::motion
