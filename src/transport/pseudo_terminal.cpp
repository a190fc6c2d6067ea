#include "interpolated_motion_driver/transport/pseudo_terminal.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::transport {
namespace {

constexpr const char* kTerminals = "/dev/pts/";

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

int open_far_end() {
  const int fd = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) fail("cannot make a pseudo-terminal");
  return fd;
}

/// Empty where there is no such link.
std::string target_of(const std::string& link) {
  std::array<char, 64> target{};
  const ssize_t length = readlink(link.c_str(), target.data(), target.size());
  return {target.data(), length > 0 ? static_cast<std::size_t>(length) : 0};
}

/// A program that was killed leaves its link behind: it leads to a terminal that is no more, or to one that
/// was made anew since. One that leads to another terminal is in use, and one that leads elsewhere is not
/// ours.
void remove_stale_link(const std::string& terminal, const std::string& link) {
  const std::string leads_to = target_of(link);
  if (leads_to.rfind(kTerminals, 0) != 0) return;
  if (leads_to == terminal || access(link.c_str(), F_OK) != 0) unlink(link.c_str());
}

}  // namespace

class PseudoTerminal::Implementation {
 public:
  Implementation(boost::asio::io_context& io, std::string link);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  boost::asio::posix::stream_descriptor far_end;
  std::string path;
  std::array<char, 256> received{};
  std::size_t read = 0;
  std::size_t filled = 0;
  HostTime received_at{};

 private:
  std::string link_;
  std::string terminal_;  ///< where link_ leads
  // Held open, so that the line goes on existing while no other program has it open.
  int near_end_ = -1;
};

PseudoTerminal::Implementation::Implementation(boost::asio::io_context& io, std::string link) : far_end(io) {
  const int fd = open_far_end();
  boost::system::error_code refused;
  far_end.assign(fd, refused);
  if (refused) {
    close(fd);
    throw std::runtime_error("cannot wait for a pseudo-terminal: " + refused.message());
  }
  std::array<char, 64> name{};
  if (grantpt(fd) != 0 || unlockpt(fd) != 0 || ptsname_r(fd, name.data(), name.size()) != 0) {
    fail("cannot set a pseudo-terminal up");
  }
  path = name.data();
  near_end_ = open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (near_end_ < 0) fail("cannot open " + path);
  termios settings{};
  tcgetattr(near_end_, &settings);
  cfmakeraw(&settings);
  tcsetattr(near_end_, TCSANOW, &settings);
  if (link.empty()) return;
  remove_stale_link(path, link);
  if (symlink(path.c_str(), link.c_str()) != 0) {
    const int error = errno;
    close(near_end_);
    errno = error;
    fail("cannot make the link " + link +
         (error == EEXIST ? " (served by another program? else remove it)" : ""));
  }
  terminal_ = path;
  path = link_ = std::move(link);
}

PseudoTerminal::Implementation::~Implementation() {
  if (!link_.empty() && target_of(link_) == terminal_) unlink(link_.c_str());
  if (near_end_ >= 0) close(near_end_);
}

PseudoTerminal::PseudoTerminal(boost::asio::io_context& io, std::string link)
    : implementation_(std::make_unique<Implementation>(io, std::move(link))) {}

PseudoTerminal::~PseudoTerminal() = default;

const std::string& PseudoTerminal::path() const { return implementation_->path; }

bool PseudoTerminal::send(std::string_view text, HostTime) {
  // A pseudo-terminal takes a text whole as long as it has room for a page; a drive's answers are far
  // shorter.
  const ssize_t written = write(implementation_->far_end.native_handle(), text.data(), text.size());
  return written == static_cast<ssize_t>(text.size());
}

std::optional<ReceivedCharacter> PseudoTerminal::receive() {
  Implementation& i = *implementation_;
  if (i.read == i.filled) {
    const ssize_t length = ::read(i.far_end.native_handle(), i.received.data(), i.received.size());
    if (length <= 0) return std::nullopt;
    i.read = 0;
    i.filled = static_cast<std::size_t>(length);
    i.received_at = read_host_clock();
  }
  return ReceivedCharacter{i.received[i.read++], i.received_at};
}

void PseudoTerminal::async_wait_readable(WaitHandler handler) {
  implementation_->far_end.async_wait(boost::asio::posix::stream_descriptor::wait_read, std::move(handler));
}

}  // namespace interpolated_motion::transport
