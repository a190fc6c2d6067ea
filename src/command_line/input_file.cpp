#include "interpolated_motion_driver/command_line/input_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::command_line {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail(const std::string& path) {
  throw std::runtime_error(fmt::format("{} cannot be read: {}", path, std::strerror(errno)));
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

std::string read_text_file(const std::string& path) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "r"));
  if (!file) fail(path);
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), file.get()))
    text.append(part.data(), size);
  if (std::ferror(file.get()) != 0) fail(path);  // a directory can be opened, but not read
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
