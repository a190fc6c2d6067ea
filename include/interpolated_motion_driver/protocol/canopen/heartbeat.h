#pragma once

#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/nmt.h"
#include "interpolated_motion_driver/protocol/canopen/ring.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

enum class HeartbeatEvent {
  Started,       ///< first heartbeat, or the first after Lost or BootUp: monitoring runs from now on
  StateChanged,  ///< a heartbeat with another state than the one before
  BootUp,        ///< the node has been reset or powered: its communication objects have their stored values
  Lost,          ///< no heartbeat within the time-out
};

/// Watches the heartbeat of one node (CiA 301, 7.2.8.2.2.2). Monitoring starts with the first heartbeat,
/// never before: a node that was not told to produce one is not lost. A boot-up message stops monitoring
/// until the next heartbeat, since EPOS2 comes up with 0x1017 = 0.
class HeartbeatConsumer {
 public:
  /// `timeout`: longest pause between heartbeats, 1.5 to 3 times the producer's period; zero or less turns
  /// monitoring off, states and boot-up are still reported.
  explicit HeartbeatConsumer(HostDuration timeout = HostDuration::zero());

  /// Another time-out, measured from the last heartbeat.
  void set_timeout(HostDuration timeout);

  /// A heartbeat or boot-up message arrived at `time`.
  void on_heartbeat(NodeState state, HostTime time);

  /// Reports `Lost` (once) when the time-out has passed.
  void poll(HostTime now);

  /// When `poll` must be called next; `kNever` when nothing is monitored.
  HostTime next_deadline() const {
    return monitoring_ && timeout_ > HostDuration::zero() ? last_heard_ + timeout_ : kNever;
  }

  /// Last state heard; `Unknown` before the first heartbeat and after `Lost`.
  NodeState state() const { return state_; }
  bool monitoring() const { return monitoring_; }  ///< from the first heartbeat to Lost or BootUp
  bool lost() const { return lost_; }              ///< from Lost to the next heartbeat or boot-up message
  /// Time of the last heartbeat or boot-up message; the epoch when there was none.
  HostTime last_heard() const { return last_heard_; }

  /// Oldest event not yet taken. Of more than eight untaken events the oldest are forgotten.
  std::optional<HeartbeatEvent> take_event() { return events_.take(); }

 private:
  HostDuration timeout_;
  NodeState state_ = NodeState::Unknown;
  bool monitoring_ = false;
  bool lost_ = false;
  HostTime last_heard_{};
  Ring<HeartbeatEvent> events_{8};
};

/// Sends this host's heartbeat, so that the drives can tell when it dies (their 0x1016): with a full FIFO
/// they would otherwise move on for up to 16 s.
class HeartbeatProducer {
 public:
  /// `node`: own node id, 1..127. `period`: zero or less is off.
  HeartbeatProducer(std::uint8_t node, HostDuration period);

  /// The heartbeat frame when one is due. The first is due at the first call. Heartbeats missed by a late
  /// call are skipped, not sent in a burst.
  std::optional<Frame> poll(HostTime now);

  /// When the next heartbeat is due; `kNever` when off or before the first call of `poll`.
  HostTime next_deadline() const { return next_; }

 private:
  Frame frame_;
  HostDuration period_;
  HostTime next_ = kNever;
};

}  // namespace interpolated_motion::canopen
