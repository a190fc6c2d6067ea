#include "can_port.h"

#include <stdexcept>
#include <utility>

namespace interpolated_motion::drive_tool {
namespace {

/// Of an interface without a rate of its own, for the load of its bus.
constexpr std::uint32_t kAssumedBitrate = 1'000'000;

canopen::SdoParameters sdo_parameters(const Options& options) {
  canopen::SdoParameters parameters;
  if (options.timeout) parameters.timeout = host_duration(*options.timeout);
  return parameters;
}

transport::SocketcanParameters parameters_of(const std::string& interface) {
  transport::SocketcanParameters parameters;
  parameters.interface = interface;
  return parameters;
}

}  // namespace

CanPort::CanPort(const Options& options)
    : bus_(waiter_.io(), parameters_of(options.place), waiter_.now()),
      interface_(open_interface()),
      session_(bus_, waiter_, interface_.bitrate.value_or(kAssumedBitrate), sdo_parameters(options)) {
  waiter_.attach([this](HostTime now) { return turn(now); },
                 [this](KernelWaiter::Handler handler) { bus_.async_wait_readable(std::move(handler)); });
}

const transport::CanInterface& CanPort::open_interface() {
  bus_.poll_interface(waiter_.now());
  const bool open =
      bus_.state() == transport::SocketcanState::Up || bus_.state() == transport::SocketcanState::BusOff;
  if (!open || !bus_.interface()) throw std::runtime_error(bus_.status_text());
  return *bus_.interface();
}

bool CanPort::turn(HostTime now) {
  bus_.poll_interface(now);
  while (const auto report = bus_.take_error()) errors_.add(*report);
  switch (bus_.state()) {
    case transport::SocketcanState::Up:
    case transport::SocketcanState::BusOff:
      return true;
    default:
      throw std::runtime_error(bus_.status_text());
  }
}

}  // namespace interpolated_motion::drive_tool
