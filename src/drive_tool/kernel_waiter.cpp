#include "kernel_waiter.h"

#include <algorithm>
#include <csignal>
#include <utility>

#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::drive_tool {
namespace {

/// A port is looked after that often, whatever else happens.
constexpr HostDuration kLongest = std::chrono::milliseconds(100);

}  // namespace

KernelWaiter::KernelWaiter() : timer_(io_), signals_(io_, SIGINT, SIGTERM, SIGHUP) {
  signals_.async_wait([this](const boost::system::error_code& error, int) {
    if (!error) interrupted_ = woken_ = true;
  });
}

void KernelWaiter::attach(Turn turn, Watch watch) {
  turn_ = std::move(turn);
  watch_ = std::move(watch);
}

HostTime KernelWaiter::now() const { return transport::read_host_clock(); }

void KernelWaiter::start_watching() {
  if (watching_ || !turn_(now())) return;
  watching_ = true;
  watch_([this](const boost::system::error_code&) {
    watching_ = false;
    woken_ = true;
  });
}

void KernelWaiter::wait(HostTime limit) {
  start_watching();
  const HostTime begin = now();
  woken_ = woken_ || limit <= begin;
  timer_.expires_after(
      std::clamp(limit <= begin ? HostDuration::zero() : limit - begin, HostDuration::zero(), kLongest));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) woken_ = true;
  });
  io_.restart();
  io_.poll();
  while (!woken_) io_.run_one();
  timer_.cancel();
  woken_ = false;
  if (interrupted_) throw Interrupted();
  turn_(now());
}

}  // namespace interpolated_motion::drive_tool
