#include "interpolated_motion_driver/command_line/file_series.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/output_file.h"

namespace interpolated_motion::command_line {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".txt";
/// Other processes may write into the same folder: so often the next number is tried.
constexpr int kTries = 100;

/// The number in the name of a file of the series; 0: it is none.
long number_in(const std::string& name, const std::string& prefix) {
  const std::string suffix = kSuffix;
  if (name.size() <= prefix.size() + suffix.size() || name.compare(0, prefix.size(), prefix) != 0) return 0;
  const std::string digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  const bool is_one = name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0 &&
                      digits.size() < 10 && digits.find_first_not_of("0123456789") == std::string::npos;
  return is_one ? std::stol(digits) : 0;
}

std::map<long, fs::path> files_of(const std::string& folder, const std::string& prefix) {
  std::map<long, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const long number = number_in(entry.path().filename().string(), prefix);
    if (number > 0) files[number] = entry.path();
  }
  return files;
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{} cannot be written: {}", path.string(), why));
}

/// False: there is a file of that name.
bool write_new(const fs::path& path, const std::string& text) {
  OpenFile file = create_output_file(path);
  if (!file) return false;
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  const int error = errno;
  if (std::fclose(file.release()) == 0 && written) return true;
  const std::string why = std::strerror(written ? errno : error);
  std::error_code ignored;
  fs::remove(path, ignored);
  fail(path, why);
}

}  // namespace

FileSeries::FileSeries(std::string folder, std::string prefix, int keep)
    : folder_(std::move(folder)), prefix_(std::move(prefix)), keep_(keep) {}

std::string FileSeries::write(const std::string& text) const {
  const fs::path folder = fs::absolute(folder_);
  try {
    fs::create_directories(folder);
    std::map<long, fs::path> files = files_of(folder_, prefix_);
    long number = files.empty() ? 0 : files.rbegin()->first;
    const auto path = [&] { return folder / fmt::format("{}{:06}{}", prefix_, number, kSuffix); };
    int tries = 0;
    do {
      ++number;
      if (++tries > kTries) fail(path(), "there are files of this and the names before it");
    } while (!write_new(path(), text));
    for (; static_cast<int>(files.size()) >= keep_; files.erase(files.begin()))
      fs::remove(files.begin()->second);
    return path().string();
  } catch (const fs::filesystem_error& error) {
    fail(folder, error.code().message());
  }
}

}  // namespace interpolated_motion::command_line
