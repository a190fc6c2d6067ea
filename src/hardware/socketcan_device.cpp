#include "interpolated_motion_driver/hardware/socketcan_device.h"

#include <utility>

namespace interpolated_motion::hardware {

namespace {

constexpr HostDuration kCountPeriod = std::chrono::milliseconds(100);

}  // namespace

SocketcanDevice::SocketcanDevice(EventLoop loop, transport::SocketcanParameters parameters, HostTime now)
    : loop_(std::move(loop)), bus_(*loop_.io, std::move(parameters), now) {}

bool SocketcanDevice::poll(HostTime now) {
  const bool changed = bus_.poll_interface(now);
  if (changed || now >= next_count_) {
    counters_ = bus_.counters();
    next_count_ = now + kCountPeriod;
  }
  return changed;
}

// In bus-off, too: the end of it is reported by an error frame.
void SocketcanDevice::watch() {
  const auto state = bus_.state();
  const bool open = state == transport::SocketcanState::Up || state == transport::SocketcanState::BusOff;
  if (watching_ || !open) return;
  watching_ = true;
  bus_.async_wait_readable([this](const boost::system::error_code&) {
    watching_ = false;
    loop_.wake();
  });
}

std::optional<std::string> SocketcanDevice::take_error() {
  const auto report = bus_.take_error();
  if (!report) return std::nullopt;
  return transport::to_string(*report);
}

}  // namespace interpolated_motion::hardware
