#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/system/error_code.hpp>

#include "interpolated_motion_driver/transport/serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

enum class SerialPortState {
  Open,
  Missing,   ///< there is no such device: not plugged in
  Unusable,  ///< there is one, but it cannot be opened or set up; the status says why
};

struct SerialPortParameters {
  std::string device;       ///< "/dev/ttyUSB0", or better a name that stays: "/dev/serial/by-id/..."
  int baud = 57600;         ///< bit/s, 300..4000000; what the adapter cannot do is found when it is opened
  int stop_bits = 2;        ///< 1 or 2. SilverLode: 8 data bits, no parity, 2 stop bits
  bool rs485 = false;       ///< let the UART switch the RS-485 driver by RTS (TIOCSRS485)
  bool low_latency = true;  ///< pass characters on at once, where the adapter can (ASYNC_LOW_LATENCY)
};

struct SerialPortCounters {
  std::uint64_t sent = 0;      ///< characters taken by the kernel
  std::uint64_t received = 0;  ///< characters
  std::uint64_t full = 0;      ///< texts refused because the transmit buffer had no room
  std::uint64_t openings = 0;  ///< 1 + returns of the device
};

/// A serial line behind a tty: 8 data bits, no parity, no flow control, raw. The port is locked against other
/// programs (TIOCEXCL, flock). Neither blocks nor sleeps. A device that is unplugged and comes back is opened
/// again by poll_port().
class SerialPortLine : public SerialLine {
 public:
  using WaitHandler = std::function<void(const boost::system::error_code&)>;

  /// Opens the device if it is there; otherwise poll_port() will. Throws std::invalid_argument for a
  /// parameter out of its range. `io` must outlive the line.
  SerialPortLine(boost::asio::io_context& io, SerialPortParameters parameters, HostTime now);
  ~SerialPortLine() override;
  SerialPortLine(const SerialPortLine&) = delete;
  SerialPortLine& operator=(const SerialPortLine&) = delete;

  bool send(std::string_view text, HostTime now) override;

  /// `time` of a character is when it was read: a tty keeps no time stamps.
  std::optional<ReceivedCharacter> receive() override;

  /// Looks whether the device has come back, 5 times a second at most and only while it is not open, and
  /// passes on the end of a text that the kernel had no room for. True when the state has changed, or the
  /// port is a new one, since the last call.
  bool poll_port(HostTime now);

  /// When to call poll_port(), or send() for a text that was refused, again; kNever while the port is open
  /// and has taken everything.
  HostTime next_deadline() const;

  /// As of the latest call that has looked at the port.
  SerialPortState state() const;
  /// The state in one sentence, with what to do.
  const std::string& status_text() const;
  /// What could not be had but is not needed (RS-485 mode, low latency), a sentence each.
  const std::vector<std::string>& advice() const;
  /// Since this was made, whatever has become of the device.
  SerialPortCounters counters() const;

  /// Calls `handler` once when characters can be read, or, with an error, when the port has been closed or is
  /// not open: wait again after poll_port() has reported Open.
  void async_wait_readable(WaitHandler handler);
  /// The same for room in the transmit buffer.
  void async_wait_writable(WaitHandler handler);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::transport
