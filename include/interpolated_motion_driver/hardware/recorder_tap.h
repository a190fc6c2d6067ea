#pragma once

#include <memory>
#include <vector>

#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/event_log.h"
#include "interpolated_motion_driver/hardware/state_history.h"
#include "interpolated_motion_driver/hardware/wire_observer.h"
#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/recording/flight_recorder.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// Where the flight recorder gets from what the hardware does: on the wire before anybody else sees it, and
/// every 20 ms from the state of joints and buses.
class RecorderTap {
 public:
  RecorderTap(const Configuration& configuration, HostTime start);

  /// Records, and hands on to the observer that was set.
  const WireObserver& wire() const { return wire_; }
  void set_observer(WireObserver observer) { observer_ = std::move(observer); }

  /// Looks at joints and buses, if it is time for that.
  void look(HostTime now, const motion::Group& group, const std::vector<std::unique_ptr<BusLink>>& links);
  /// The group has come into another state: it is told, and looked at at once.
  void follow(HostTime now, motion::GroupState before, const motion::Group& group);
  void log(HostTime now, const LogEntry& entry);
  /// The group has been asked for something.
  void request(HostTime now, motion::RequestKind kind, motion::RequestId id);
  void speed(HostTime now, const motion::SpeedOrder& order);
  /// The driver, which was to be called until `due`, is called at `now`: an absence of the host if that is
  /// much later.
  void note_call(HostTime due, HostTime now);

  /// What these looks have seen.
  const StateHistory& history() const { return history_; }

  recording::FlightRecorder& recorder() { return recorder_; }
  const recording::FlightRecorder& recorder() const { return recorder_; }

 private:
  void note_desired(HostTime now, const motion::Group& group);

  recording::FlightRecorder recorder_;
  WireObserver observer_;
  WireObserver wire_;
  motion::Snapshot snapshot_;
  StateHistory history_;
  std::vector<trajectory::State> desired_;  ///< scratch
  HostTime next_look_ = HostTime::min();
};

/// Everything published of group and buses, as of `now`.
void take_snapshot(HostTime now, const motion::Group& group,
                   const std::vector<std::unique_ptr<BusLink>>& links, motion::Snapshot& out);

}  // namespace interpolated_motion::hardware
