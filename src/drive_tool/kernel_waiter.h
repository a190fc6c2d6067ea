#pragma once

#include <functional>
#include <stdexcept>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>

#include "interpolated_motion_driver/commissioning/waiter.h"

namespace interpolated_motion::drive_tool {

/// The user has had enough: SIGINT, SIGTERM or SIGHUP.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Waits in the kernel, for a port and for signals.
class KernelWaiter : public commissioning::Waiter {
 public:
  using Handler = std::function<void(const boost::system::error_code&)>;
  /// What the port does at each turn, and whether it can be waited for: it has been closed otherwise.
  using Turn = std::function<bool(HostTime now)>;
  /// Calls the handler once when there is something to read.
  using Watch = std::function<void(Handler)>;

  KernelWaiter();

  boost::asio::io_context& io() { return io_; }
  /// The port that is waited for; both must live as long as this waits.
  void attach(Turn turn, Watch watch);

  HostTime now() const override;
  /// Throws Interrupted, and what the port's turn throws.
  void wait(HostTime limit) override;

 private:
  void start_watching();

  boost::asio::io_context io_;
  boost::asio::steady_timer timer_;
  boost::asio::signal_set signals_;
  Turn turn_;
  Watch watch_;
  bool watching_ = false;
  bool woken_ = false;
  bool interrupted_ = false;
};

}  // namespace interpolated_motion::drive_tool
