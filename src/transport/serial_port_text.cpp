#include "serial_port_text.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace interpolated_motion::transport {
namespace {

constexpr int kLowestBaud = 300;
constexpr int kHighestBaud = 4'000'000;

[[noreturn]] void refuse(const SerialPortParameters& parameters, const std::string& what) {
  throw std::invalid_argument(fmt::format("serial port \"{}\": {}", parameters.device, what));
}

}  // namespace

std::string open_error_text(const SerialPortParameters& parameters, int error) {
  const std::string& device = parameters.device;
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return fmt::format(
          "there is no serial port {}: plug the adapter in; ls /dev/serial/by-id shows those there are",
          device);
    case EACCES:
    case EPERM:
      return fmt::format(
          "no permission to open {}: add yourself to the group dialout (sudo usermod -aG dialout $USER) and "
          "log in again",
          device);
    case EBUSY:
    case EWOULDBLOCK:
      return fmt::format("{} is in use by another program: sudo fuser -v {} tells which", device, device);
    case ENOTTY:
      return fmt::format("{} is not a serial port", device);
    case EINVAL:
      return fmt::format("{} cannot do {} bit/s", device, parameters.baud);
    default:
      return fmt::format("{} cannot be opened: {}", device, std::generic_category().message(error));
  }
}

void validate(const SerialPortParameters& p) {
  if (p.device.empty()) refuse(p, "a device is needed, such as /dev/ttyUSB0");
  if (p.baud < kLowestBaud || p.baud > kHighestBaud) {
    refuse(p, fmt::format("baud is {}; allowed: {}..{}", p.baud, kLowestBaud, kHighestBaud));
  }
  if (p.stop_bits != 1 && p.stop_bits != 2) {
    refuse(p, fmt::format("stop_bits is {}; allowed: 1, 2", p.stop_bits));
  }
}

}  // namespace interpolated_motion::transport
