#include "failing_calls/failing_calls.h"

#include <sys/epoll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/types.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <filesystem>
#include <iterator>

namespace {

std::string failing;
int left = 0;
int failure = 0;
int counted = 0;

/// Counts a call, and says whether it is the one to fail.
bool fails(const char* call) {
  if (counted == 0 || left == 0 || failing != call) return false;
  if (--left > 0) return false;
  errno = failure;
  return true;
}

}  // namespace

// The names are the linker's.
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
int __real_open(const char* path, int flags, ...);
int __wrap_open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const auto mode = va_arg(arguments, int);
  va_end(arguments);
  return fails("open") ? -1 : __real_open(path, flags, mode);
}
ssize_t __real_read(int fd, void* bytes, std::size_t size);
ssize_t __wrap_read(int fd, void* bytes, std::size_t size) {
  return fails("read") ? -1 : __real_read(fd, bytes, size);
}
ssize_t __real_write(int fd, const void* bytes, std::size_t size);
ssize_t __wrap_write(int fd, const void* bytes, std::size_t size) {
  return fails("write") ? -1 : __real_write(fd, bytes, size);
}
int __real_ioctl(int fd, unsigned long request, ...);
int __wrap_ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  return fails("ioctl") ? -1 : __real_ioctl(fd, request, argument);
}
int __real_flock(int fd, int operation);
int __wrap_flock(int fd, int operation) { return fails("flock") ? -1 : __real_flock(fd, operation); }
int __real_isatty(int fd);
int __wrap_isatty(int fd) { return fails("isatty") ? 0 : __real_isatty(fd); }
int __real_epoll_ctl(int epoll, int operation, int fd, epoll_event* event);
int __wrap_epoll_ctl(int epoll, int operation, int fd, epoll_event* event) {
  return fails("epoll_ctl") ? -1 : __real_epoll_ctl(epoll, operation, fd, event);
}
int __real_socket(int domain, int type, int protocol);
int __wrap_socket(int domain, int type, int protocol) {
  return fails("socket") ? -1 : __real_socket(domain, type, protocol);
}
int __real_bind(int fd, const sockaddr* address, socklen_t size);
int __wrap_bind(int fd, const sockaddr* address, socklen_t size) {
  return fails("bind") ? -1 : __real_bind(fd, address, size);
}
int __real_setsockopt(int fd, int level, int option, const void* value, socklen_t size);
int __wrap_setsockopt(int fd, int level, int option, const void* value, socklen_t size) {
  return fails("setsockopt") ? -1 : __real_setsockopt(fd, level, option, value, size);
}
int __real_recvmmsg(int fd, mmsghdr* messages, unsigned count, int flags, timespec* timeout);
int __wrap_recvmmsg(int fd, mmsghdr* messages, unsigned count, int flags, timespec* timeout) {
  return fails("recvmmsg") ? -1 : __real_recvmmsg(fd, messages, count, flags, timeout);
}
ssize_t __real_send(int fd, const void* bytes, std::size_t size, int flags);
ssize_t __wrap_send(int fd, const void* bytes, std::size_t size, int flags) {
  return fails("send") ? -1 : __real_send(fd, bytes, size, flags);
}
ssize_t __real_recv(int fd, void* bytes, std::size_t size, int flags);
ssize_t __wrap_recv(int fd, void* bytes, std::size_t size, int flags) {
  return fails("recv") ? -1 : __real_recv(fd, bytes, size, flags);
}
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)

namespace interpolated_motion::test {

const std::vector<std::string>& failing_calls() {
  static const std::vector<std::string> calls{"open",     "read",      "write",  "ioctl", "flock",
                                              "isatty",   "epoll_ctl", "socket", "bind",  "setsockopt",
                                              "recvmmsg", "send",      "recv"};
  return calls;
}

FailingCall::FailingCall(const std::string& call, int n, int error) {
  failing = call;
  left = n;
  failure = error;
}

FailingCall::~FailingCall() { left = 0; }

bool FailingCall::has_happened() const { return left == 0; }

Counted::Counted() { ++counted; }
Counted::~Counted() { --counted; }

int open_descriptors() {
  namespace fs = std::filesystem;
  return static_cast<int>(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

}  // namespace interpolated_motion::test
