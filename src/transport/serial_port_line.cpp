#include "interpolated_motion_driver/transport/serial_port_line.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/error.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>

#include "interpolated_motion_driver/transport/host_clock.h"
#include "serial_port_text.h"
#include "serial_settings.h"

namespace interpolated_motion::transport {
namespace {

using Descriptor = boost::asio::posix::stream_descriptor;

constexpr HostDuration kPollPeriod = std::chrono::milliseconds(200);
/// When the transmit buffer was full, the end of a text is offered again after that time: some characters at
/// 57600 bit/s.
constexpr HostDuration kRetryPeriod = std::chrono::milliseconds(1);

}  // namespace

class SerialPortLine::Implementation {
 public:
  Implementation(boost::asio::io_context& io, SerialPortParameters wanted)
      : parameters(std::move(wanted)), io_(io), port_(io) {}
  ~Implementation() { close(); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void open();
  bool send(std::string_view text);
  bool flush();
  std::optional<ReceivedCharacter> receive();
  void async_wait(Descriptor::wait_type what, WaitHandler handler);

  SerialPortParameters parameters;
  SerialPortState state = SerialPortState::Missing;
  bool changed = true;  ///< since poll_port() told the last time
  std::string status;
  std::vector<std::string> advice;
  SerialPortCounters counters;
  HostTime next_poll{};
  HostTime retry_at{};   ///< when `unsent` is offered again
  bool refused = false;  ///< the latest text found no room
  std::string unsent;    ///< the end of a text of which the kernel has taken the beginning

 private:
  std::size_t write(std::string_view text);
  int set_up(int fd);
  void enter(SerialPortState next, std::string text);
  void close();
  void leave(int error);
  bool fill();

  boost::asio::io_context& io_;
  Descriptor port_;  ///< boost::asio::serial_port cannot be waited for without reading
  std::array<char, 256> received_{};
  std::size_t read_ = 0;
  std::size_t filled_ = 0;
  HostTime received_at_{};
};

void SerialPortLine::Implementation::open() {
  const int fd = ::open(parameters.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return leave(errno);
  if (const int error = set_up(fd)) {
    ::close(fd);
    return leave(error);
  }
  boost::system::error_code error;  // the kernel may have no memory for one more descriptor to wait for
  port_.assign(fd, error);
  if (error) {
    unlock_port(fd);
    ::close(fd);
    return leave(error.value());
  }
  read_ = filled_ = 0;
  unsent.clear();
  changed = true;
  ++counters.openings;
  enter(SerialPortState::Open, fmt::format("{} is open at {} bit/s, 8N{}", parameters.device, parameters.baud,
                                           parameters.stop_bits));
}

int SerialPortLine::Implementation::set_up(int fd) {
  if (isatty(fd) == 0) return ENOTTY;
  if (const int error = lock_port(fd)) return error;
  if (const int error = set_line_settings(fd, parameters)) return error;
  advice.clear();
  if (parameters.rs485 && set_rs485(fd) != 0) {
    advice.push_back(fmt::format(
        "{} has no RS-485 mode of its own (TIOCSRS485): its adapter must switch the direction by itself",
        parameters.device));
  }
  if (parameters.low_latency && set_low_latency(fd) != 0) {
    advice.push_back(fmt::format("{} has no low-latency mode; answers may come some milliseconds late",
                                 parameters.device));
  }
  discard_old(fd);
  return 0;
}

void SerialPortLine::Implementation::enter(SerialPortState next, std::string text) {
  changed = changed || next != state;
  state = next;
  status = std::move(text);
}

void SerialPortLine::Implementation::close() {
  if (!port_.is_open()) return;
  changed = true;
  unlock_port(port_.native_handle());
  boost::system::error_code ignored;
  port_.close(ignored);
}

void SerialPortLine::Implementation::leave(int error) {
  close();
  const bool missing = error == ENOENT || error == ENXIO || error == ENODEV || error == EIO;
  enter(missing ? SerialPortState::Missing : SerialPortState::Unusable,
        open_error_text(parameters, error == EIO ? ENODEV : error));
}

// A text goes whole or not at all. The kernel may take only its beginning; the end then waits here, and is
// offered again before anything else.
bool SerialPortLine::Implementation::send(std::string_view text) {
  if (!flush()) return false;
  const std::size_t taken = write(text);
  if (taken == 0) ++counters.full;
  if (taken > 0) unsent = text.substr(taken);
  return taken > 0;
}

bool SerialPortLine::Implementation::flush() {
  if (state != SerialPortState::Open) return false;
  if (!unsent.empty()) unsent.erase(0, write(unsent));
  return state == SerialPortState::Open && unsent.empty();
}

std::size_t SerialPortLine::Implementation::write(std::string_view text) {
  const ssize_t written = ::write(port_.native_handle(), text.data(), text.size());
  if (written < 0 && errno != EAGAIN && errno != EINTR) leave(errno);
  if (written <= 0) return 0;
  counters.sent += static_cast<std::uint64_t>(written);
  return static_cast<std::size_t>(written);
}

bool SerialPortLine::Implementation::fill() {
  const ssize_t length = ::read(port_.native_handle(), received_.data(), received_.size());
  if (length < 0 && errno != EAGAIN && errno != EINTR) leave(errno);
  if (length == 0) leave(ENODEV);  // a tty that was hung up
  if (length <= 0) return false;
  read_ = 0;
  filled_ = static_cast<std::size_t>(length);
  received_at_ = read_host_clock();
  counters.received += filled_;
  return true;
}

std::optional<ReceivedCharacter> SerialPortLine::Implementation::receive() {
  if (state != SerialPortState::Open) return std::nullopt;
  if (read_ == filled_ && !fill()) return std::nullopt;
  return ReceivedCharacter{received_[read_++], received_at_};
}

void SerialPortLine::Implementation::async_wait(Descriptor::wait_type what, WaitHandler handler) {
  if (state == SerialPortState::Open) {
    port_.async_wait(what, std::move(handler));
  } else {
    boost::asio::post(io_, [handler = std::move(handler)] { handler(boost::asio::error::not_connected); });
  }
}

SerialPortLine::SerialPortLine(boost::asio::io_context& io, SerialPortParameters parameters, HostTime now) {
  validate(parameters);
  implementation_ = std::make_unique<Implementation>(io, std::move(parameters));
  implementation_->next_poll = now + kPollPeriod;
  implementation_->open();
}

SerialPortLine::~SerialPortLine() = default;

bool SerialPortLine::send(std::string_view text, HostTime now) {
  implementation_->retry_at = now + kRetryPeriod;
  const bool taken = implementation_->send(text);
  implementation_->refused = !taken;
  return taken;
}

std::optional<ReceivedCharacter> SerialPortLine::receive() { return implementation_->receive(); }

bool SerialPortLine::poll_port(HostTime now) {
  Implementation& i = *implementation_;
  if (i.state != SerialPortState::Open && now >= i.next_poll) {
    i.next_poll = now + kPollPeriod;
    i.open();
  }
  if (now >= i.retry_at) i.refused = false;
  if (!i.unsent.empty() && now >= i.retry_at) {
    i.retry_at = now + kRetryPeriod;
    i.flush();
  }
  return std::exchange(i.changed, false);
}

HostTime SerialPortLine::next_deadline() const {
  const Implementation& i = *implementation_;
  if (i.state != SerialPortState::Open) return i.next_poll;
  return i.unsent.empty() && !i.refused ? kNever : i.retry_at;
}

SerialPortState SerialPortLine::state() const { return implementation_->state; }

const std::string& SerialPortLine::status_text() const { return implementation_->status; }

const std::vector<std::string>& SerialPortLine::advice() const { return implementation_->advice; }

SerialPortCounters SerialPortLine::counters() const { return implementation_->counters; }

void SerialPortLine::async_wait_readable(WaitHandler handler) {
  implementation_->async_wait(Descriptor::wait_read, std::move(handler));
}

void SerialPortLine::async_wait_writable(WaitHandler handler) {
  implementation_->async_wait(Descriptor::wait_write, std::move(handler));
}

}  // namespace interpolated_motion::transport
