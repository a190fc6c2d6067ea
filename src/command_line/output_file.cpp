#include "interpolated_motion_driver/command_line/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "file_descriptor.h"

namespace interpolated_motion::command_line {
namespace {

constexpr mode_t kMode = 0666;  // less what the user's umask takes
constexpr std::size_t kLongestLine = 255;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{} cannot be written: {}", path, why));
}

/// Opening a device may do something to it already.
void refuse_unopened(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return;
  if (S_ISLNK(status.st_mode)) fail(path, "it is a symbolic link. Name the file itself");
  if (!S_ISREG(status.st_mode)) fail(path, fmt::format("it is {}. Name a file", kind_text(status.st_mode)));
}

std::string first_line(int descriptor) {
  std::array<char, kLongestLine> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  const std::string start(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return start.substr(0, start.find('\n'));
}

bool ends_within_a_line(int descriptor, off_t size) {
  char last = '\n';
  return size > 0 && pread(descriptor, &last, 1, size - 1) == 1 && last != '\n';
}

void empty(int descriptor, const std::string& path) {
  if (ftruncate(descriptor, 0) != 0) fail(path, std::strerror(errno));
}

/// `mode`: of fdopen(), which empties nothing.
OpenFile stream_of(FileDescriptor descriptor, const char* mode, const std::string& path) {
  OpenFile file(fdopen(descriptor.get(), mode));
  if (!file) fail(path, std::strerror(errno));
  descriptor.release();
  return file;
}

}  // namespace

OpenFile open_output_file(const std::string& path, EarlierFile earlier, IsOurs is_ours) {
  refuse_unopened(path);
  FileDescriptor descriptor(
      open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, kMode));
  if (!descriptor) fail(path, std::strerror(errno));
  const struct stat status = status_of(descriptor.get());
  if (!S_ISREG(status.st_mode)) fail(path, fmt::format("it is {}. Name a file", kind_text(status.st_mode)));
  if (status.st_size > 0 && !is_ours(first_line(descriptor.get()))) {
    fail(path,
         "there is a file of that name with something else in it, which is kept. Name another file, or "
         "remove it");
  }
  if (earlier == EarlierFile::Replace) {
    empty(descriptor.get(), path);
    return stream_of(std::move(descriptor), "w", path);
  }
  const bool needs_newline = ends_within_a_line(descriptor.get(), status.st_size);
  OpenFile file = stream_of(std::move(descriptor), "a", path);
  if (needs_newline) std::fputc('\n', file.get());
  return file;
}

OpenFile create_output_file(const std::string& path) {
  FileDescriptor descriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  if (!descriptor && errno == EEXIST) return nullptr;
  if (!descriptor) fail(path, std::strerror(errno));
  return stream_of(std::move(descriptor), "w", path);
}

void begin_anew(std::FILE* file, const std::string& path) {
  std::rewind(file);  // what is buffered goes before
  empty(fileno(file), path);
}

}  // namespace interpolated_motion::command_line
