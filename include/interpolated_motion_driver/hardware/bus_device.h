#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// Where buses outside of the process wait for their descriptors.
struct EventLoop {
  boost::asio::io_context* io = nullptr;  ///< run by the thread that owns the hardware, which it must outlive
  std::function<void()> wake;             ///< called from `io` when a bus has news: update() is due
};

/// What a bus outside of the process is reached through: a CAN interface or a serial port. It may be missing,
/// or come and go at any time. Neither blocks nor reads a clock.
class BusDevice {
 public:
  virtual ~BusDevice() = default;

  /// Looks whether the device has come, gone or changed. True when it has, or is a new one, since the last
  /// call: what was under way then is lost.
  virtual bool poll(HostTime now) = 0;
  /// When to call poll(), or to offer what it has refused, again; kNever while all is well.
  virtual HostTime next_deadline() const = 0;
  /// Has EventLoop::wake called once when something arrives. To be called again after each receiving.
  virtual void watch() = 0;

  /// Something can be sent and received, as of the latest poll(), sending or receiving. While not, BusLink
  /// drops what its master wants to send.
  virtual bool usable() const = 0;
  /// The state in one sentence, with what to do.
  virtual const std::string& status() const = 0;
  /// Settings that could be better, a sentence each. As of the last opening.
  virtual const std::vector<std::string>& advice() const = 0;

  /// What the controller has reported about the bus, oldest first, in words.
  virtual std::optional<std::string> take_error() = 0;
  /// Reports of the CAN controller about a disturbed bus, since the device was made; 0 of a serial port.
  virtual std::uint64_t error_frames() const = 0;
  /// Frames that the kernel had no room for, and frames taken for sending that have not been on the bus.
  virtual std::uint64_t lost_frames() const = 0;
};

}  // namespace interpolated_motion::hardware
