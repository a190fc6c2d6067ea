#include "interpolated_motion_driver/command_line/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "file_descriptor.h"

namespace interpolated_motion::command_line {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{} cannot be read: {}", path, why));
}

/// yaml-cpp takes the first of two values, other programs the last.
void refuse_duplicates(const YAML::Node& node, const std::string& path) {
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const bool is_map = node.IsMap();
    const YAML::Node value = is_map ? YAML::Node(entry.second) : YAML::Node(entry);
    if (is_map && entry.first.IsScalar() && !seen.insert(entry.first.Scalar()).second) {
      const YAML::Mark mark = entry.first.Mark();
      throw std::runtime_error(fmt::format("{}:{}:{}: key \"{}\" is given twice; leave one of both out", path,
                                           mark.line + 1, mark.column + 1, entry.first.Scalar()));
    }
    if (value.IsMap() || value.IsSequence()) refuse_duplicates(value, path);
  }
}

}  // namespace

OpenFile open_input_file(const std::string& path) {
  FileDescriptor descriptor(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!descriptor) fail(path, std::strerror(errno));
  const mode_t mode = status_of(descriptor.get()).st_mode;
  if (S_ISDIR(mode)) fail(path, std::strerror(EISDIR));
  if (!S_ISREG(mode)) fail(path, fmt::format("it is {}. Name a file", kind_text(mode)));
  OpenFile file(fdopen(descriptor.get(), "r"));
  if (!file) fail(path, std::strerror(errno));
  descriptor.release();
  return file;
}

std::string read_text_file(const std::string& path) {
  const OpenFile file = open_input_file(path);
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), file.get()))
    text.append(part.data(), size);
  if (std::ferror(file.get()) != 0) fail(path, std::strerror(errno));
  return text;
}

YAML::Node read_yaml_file(const std::string& path) {
  const std::string text = read_text_file(path);
  try {
    YAML::Node content = YAML::Load(text);
    refuse_duplicates(content, path);
    return content;
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(
        fmt::format("{}:{}:{}: {}", path, error.mark.line + 1, error.mark.column + 1, error.msg));
  }
}

}  // namespace interpolated_motion::command_line
