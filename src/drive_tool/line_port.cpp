#include "line_port.h"

#include <stdexcept>
#include <utility>

namespace interpolated_motion::drive_tool {
namespace {

/// s; drives without a delay of their own (ADL) answer within milliseconds.
constexpr double kReplyTimeout = 0.025;

transport::SerialPortParameters port_parameters(const std::string& device, int baud) {
  transport::SerialPortParameters parameters;
  parameters.device = device;
  parameters.baud = baud;
  return parameters;
}

silverlode::LineParameters line_parameters(const Options& options, int baud) {
  silverlode::LineParameters parameters;
  parameters.baud = static_cast<std::uint32_t>(baud);
  parameters.reply_timeout = host_duration(options.timeout.value_or(kReplyTimeout));
  return parameters;
}

}  // namespace

LinePort::LinePort(const Options& options, int baud)
    : line_(waiter_.io(), port_parameters(options.place, baud), waiter_.now()),
      session_(line_, waiter_, options.place, line_parameters(options, baud)) {
  turn(waiter_.now());
  waiter_.attach([this](HostTime now) { return turn(now); },
                 [this](KernelWaiter::Handler handler) { line_.async_wait_readable(std::move(handler)); });
}

bool LinePort::turn(HostTime now) {
  line_.poll_port(now);
  if (line_.state() != transport::SerialPortState::Open) throw std::runtime_error(line_.status_text());
  return true;
}

}  // namespace interpolated_motion::drive_tool
