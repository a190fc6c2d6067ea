#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/transport/can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

class Stranger;

/// A node on a virtual bus; told about each frame of the other nodes.
class CanListener {
 public:
  virtual ~CanListener() = default;

  /// `time` is that of the frame's last bit. May send, but not process the bus.
  virtual void on_can_frame(const canopen::Frame& frame, HostTime time) = 0;
};

/// What has been on a virtual bus since it was made.
struct CanBusStatistics {
  std::uint64_t frames = 0;       ///< frames transmitted to their end
  std::uint64_t bits = 0;         ///< bit times those took, stuff bits and interframe spaces included
  std::uint64_t lost = 0;         ///< frames taken away by an injection
  double load_last_second = 0.0;  ///< 0..1, in the last full second of bus time
  double load_peak = 0.0;         ///< 0..1, in the busiest full second
};

/// A CAN bus inside the process, with the time real frames take on it (ISO 11898-1): one frame at a time;
/// whenever the bus is idle, the lowest identifier among the heads of all transmit queues wins (a data frame
/// before a remote frame of the same identifier); it occupies the bus for all its bits, stuff bits and the
/// interframe space included; all other ports receive it at its last bit, and the sender gets its
/// confirmation. Port 0 is the host.
///
/// A frame needs a receiver that acknowledges it: while no other port is connected, frames stay in their
/// queues.
class VirtualCanBus {
 public:
  using Predicate = std::function<bool(const canopen::Frame&)>;
  using Tamper = std::function<void(canopen::Frame&)>;

  static constexpr std::size_t kHostQueue = 128;  ///< frames; the driver's own choice of a socket's queue
  static constexpr std::size_t kDriveQueue = 32;  ///< frames

  /// `bitrate` in bit/s, 10'000..1'000'000, else std::invalid_argument. `start` is the time of the idle bus.
  VirtualCanBus(std::string name, int bitrate, HostTime start = HostTime{},
                std::size_t host_queue = kHostQueue);
  ~VirtualCanBus();
  VirtualCanBus(const VirtualCanBus&) = delete;
  VirtualCanBus& operator=(const VirtualCanBus&) = delete;

  /// As given to the constructor; the bit rate in bit/s.
  const std::string& name() const { return name_; }
  int bitrate() const { return bitrate_; }

  /// Frames take no time (true), for a bus that is the near end of a real one, on which they take theirs.
  /// Arbitration, queues and injections stay. Applies from the next frame on.
  void set_instantaneous(bool instantaneous) { instantaneous_ = instantaneous; }

  /// The host's end of the bus.
  CanBus& host();

  /// A further node, connected at once; returns its port number (1, 2, ...). `listener` must outlive the bus
  /// or be disconnected before.
  int add_port(CanListener& listener, std::size_t queue_capacity = kDriveQueue);

  /// Queues a frame at a port. Returns false when that queue is full or the node is disconnected; the host's
  /// queue goes on taking frames while it is unplugged.
  bool send(int port, const canopen::Frame& frame, HostTime now);

  /// A node of nobody's, on the bus from the first call on.
  Stranger& stranger();

  /// Number of frames that can still be queued at a port.
  std::size_t free_slots(int port) const;

  /// Time of the next change on the bus (a frame starts or ends), kNever when there is nothing to send.
  HostTime next_event() const { return next_event_; }

  /// Runs the bus up to and including `now`: starts, ends and delivers frames.
  void process(HostTime now);

  /// Frames delivered to the host so far, whether read or not (confirmations included).
  std::uint64_t delivered_to_host() const { return delivered_to_host_; }

  /// Figures up to the last call of process().
  const CanBusStatistics& statistics() const { return statistics_; }

  /// The next `count` frames reach nobody but still take their time and are confirmed to their sender.
  void drop_next(int count) { faults_.drop = count; }

  /// The `n`-th frame from now on, the next one being the first, reaches nobody; 0: none.
  void drop_nth(int n) { faults_.drop_nth = n; }

  /// The host's `n`-th send() from now on fails, as it does when a queue is full; 0: none.
  void refuse_nth(int n) { faults_.refuse_nth = n; }

  /// Frames for which `predicate` is true reach nobody. An empty function ends that.
  void drop_if(Predicate predicate) { faults_.drop_if = std::move(predicate); }

  /// `tamper` may change each frame between its sender and its receivers. An empty function ends that.
  void tamper(Tamper tamper) { faults_.tamper = std::move(tamper); }

  /// Plugs a port in or out (port 0: the host). A port that is out neither sends nor receives; what a node
  /// had queued is lost, what the host had queued stays in its queue, as in a socket.
  void connect(int port, bool connected, HostTime now);

  /// The host's controller is bus-off until `until`: its queue is lost, it sends and receives nothing.
  void host_bus_off(HostTime until);

 private:
  struct Port;
  class HostPort;

  struct Faults {
    int drop = 0;        ///< so many of the next frames
    int drop_nth = 0;    ///< the frame that comes in so many
    int refuse_nth = 0;  ///< of the host
    Predicate drop_if;
    Tamper tamper;
  };

  void start_frame(HostTime now);
  void end_frame();
  int winner(HostTime start) const;
  bool acknowledged(int sender) const;
  HostTime earliest_start() const;
  void deliver(const canopen::Frame& frame, HostTime time);
  void account(HostTime end, int bits);
  void schedule();

  std::string name_;
  int bitrate_;
  HostTime clock_;
  HostTime free_at_;
  HostTime end_at_;
  HostTime next_event_ = kNever;
  HostTime host_off_until_;
  int sender_ = -1;
  int frame_bits_ = 0;
  bool instantaneous_ = false;
  canopen::Frame current_;
  std::vector<Port> ports_;
  std::unique_ptr<HostPort> host_;
  std::unique_ptr<Stranger> stranger_;
  std::uint64_t delivered_to_host_ = 0;
  Faults faults_;
  CanBusStatistics statistics_;
  HostTime second_start_;
  std::int64_t second_busy_ = 0;
};

}  // namespace interpolated_motion::transport
