#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/system/error_code.hpp>

#include "interpolated_motion_driver/transport/can_bus.h"
#include "interpolated_motion_driver/transport/can_error_frame.h"
#include "interpolated_motion_driver/transport/can_interface.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

enum class SocketcanState {
  Up,        ///< frames travel
  BusOff,    ///< the controller has taken itself off the bus; over when it is restarted
  Down,      ///< the interface exists but is switched off
  Missing,   ///< there is no such interface
  Unusable,  ///< it must not be used: wrong bit rate, listen-only, no CAN interface, or no permission
};

struct SocketcanParameters {
  std::string interface;      ///< name of the network interface, 1..15 characters: "can0"
  std::uint32_t bitrate = 0;  ///< bit/s that the interface must have; 0: any
  /// CANopen node ids (0..127, this host's own among them) whose frames are received, along with those of the
  /// predefined connection set that are for all (NMT, SYNC, TIME). Empty: every frame on the bus.
  std::vector<std::uint8_t> node_ids;
  std::vector<std::uint32_t> further_ids;  ///< standard identifiers received beyond those of `node_ids`
  int receive_buffer = 4 << 20;      ///< bytes; the kernel limits it to net.core.rmem_max unless run by root
  int send_buffer = 0;               ///< bytes; 0: the kernel's default
  std::size_t transmit_limit = 128;  ///< frames on their way to the bus at a time, >= 1: more wait outside,
                                     ///< where an urgent one can still be put before them
  /// Own frames are heard again when they have been on the bus, and then count as sent; otherwise, and with
  /// half the system calls, when the kernel has taken them.
  bool confirmed = true;
};

struct SocketcanCounters {
  std::uint64_t sent = 0;         ///< frames that have been on the bus, see SocketcanParameters::confirmed
  std::uint64_t received = 0;     ///< frames of others
  std::uint64_t unconfirmed = 0;  ///< frames taken and then given up: bus-off, interface down, no answer
  std::uint64_t receive_overflow = 0;  ///< frames the kernel had no room for
  std::uint64_t queue_full = 0;        ///< times the interface's queue was full (ENOBUFS)
  std::uint64_t socket_full = 0;       ///< times the socket's buffer was full (EAGAIN)
  std::uint64_t error_frames = 0;      ///< reports of the controller, see CanErrorReport
  std::uint64_t bus_off = 0;           ///< times the controller went off the bus
  std::uint64_t openings = 0;          ///< times the socket was opened: 1 + returns of the interface
};

/// A CAN bus behind a SocketCAN interface, a real one or vcan. Neither blocks nor sleeps. Frames are in the
/// clock of the kernel's time stamps, converted to CLOCK_MONOTONIC.
///
/// A frame counts as sent when it has been on the bus: CAN_RAW_RECV_OWN_MSGS. A full transmit queue
/// (ENOBUFS, EAGAIN) makes send() refuse until a frame has left; nothing is dropped and the order stays. When
/// the interface goes down, is removed or comes back, poll_interface() follows.
///
///     bus.async_wait_readable([&](auto error) { ... while (auto frame = bus.receive()) ... wait again });
class SocketcanBus : public CanBus {
 public:
  using WaitHandler = std::function<void(const boost::system::error_code&)>;

  /// Opens the interface if it is there; otherwise poll_interface() will. Throws std::invalid_argument for a
  /// parameter out of its range. `io` must outlive the bus.
  SocketcanBus(boost::asio::io_context& io, SocketcanParameters parameters, HostTime now);
  ~SocketcanBus() override;
  SocketcanBus(const SocketcanBus&) = delete;
  SocketcanBus& operator=(const SocketcanBus&) = delete;

  bool send(const canopen::Frame& frame, HostTime now) override;
  std::optional<canopen::ReceivedFrame> receive() override;

  /// Looks whether the interface has come, gone or changed; opens it again when it can be used. Cheap to call
  /// at each turn of a loop: it asks the kernel while the state is not Up only, and then 5 times a second.
  /// True when the state has changed, or the socket is a new one, since the last call.
  bool poll_interface(HostTime now);

  /// When to call poll_interface() or send() again without a frame having come; kNever while all is well.
  HostTime next_deadline() const;

  /// As of the latest call that has looked at the interface.
  SocketcanState state() const;
  /// The state in one sentence, with what to do: "CAN interface can0 is down: sudo ip link set dev can0 up
  /// type can bitrate 1000000 restart-ms 100".
  const std::string& status_text() const;
  /// Settings of interface and kernel that could be better, a sentence each. As of the last opening.
  const std::vector<std::string>& advice() const;
  /// The interface as last read; none while it is missing.
  const std::optional<CanInterface>& interface() const;

  /// Asks the kernel for the overflows, too.
  SocketcanCounters counters();
  /// The next error frame received, oldest first. The newest 64 are kept.
  std::optional<CanErrorReport> take_error();

  /// Calls `handler` once when frames can be read, or, with an error, when the socket has been closed or
  /// there is none (boost::asio::error::not_connected): wait again after poll_interface() has reported Up.
  void async_wait_readable(WaitHandler handler);
  /// The same for room in the socket's buffer. Room in the interface's queue shows as own frames received.
  void async_wait_writable(WaitHandler handler);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::transport
