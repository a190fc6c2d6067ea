#include "serial_settings.h"

// asm/termbits.h and termios.h define the same names: only the kernel's own set has BOTHER.
#include <asm/termbits.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstdlib>

namespace interpolated_motion::transport {

int set_line_settings(int fd, const SerialPortParameters& parameters) {
  termios2 settings{};
  if (ioctl(fd, TCGETS2, &settings) != 0) return errno;
  settings.c_iflag = IGNBRK | IGNPAR;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
  if (parameters.stop_bits == 2) settings.c_cflag |= CSTOPB;
  settings.c_cc[VMIN] = 1;  // reading 0 characters then means that the tty was hung up
  settings.c_cc[VTIME] = 0;
  settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(parameters.baud);
  if (ioctl(fd, TCSETS2, &settings) != 0) return errno;
  if (ioctl(fd, TCGETS2, &settings) != 0) return errno;
  const int off = std::abs(static_cast<int>(settings.c_ospeed) - parameters.baud);
  return off * 50 > parameters.baud ? EINVAL : 0;
}

int lock_port(int fd) {
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) return errno;
  return ioctl(fd, TIOCEXCL) != 0 ? errno : 0;
}

void unlock_port(int fd) {
  ioctl(fd, TIOCNXCL);
  flock(fd, LOCK_UN);
}

void discard_old(int fd) { ioctl(fd, TCFLSH, TCIOFLUSH); }

int set_low_latency(int fd) {
  serial_struct serial{};
  if (ioctl(fd, TIOCGSERIAL, &serial) != 0) return errno;
  serial.flags |= ASYNC_LOW_LATENCY;
  return ioctl(fd, TIOCSSERIAL, &serial) != 0 ? errno : 0;
}

int set_rs485(int fd) {
  serial_rs485 mode{};
  mode.flags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
  return ioctl(fd, TIOCSRS485, &mode) != 0 ? errno : 0;
}

}  // namespace interpolated_motion::transport
