// A goal file, as trajectory_client reads it: refused with the file's name and a reason, or a trajectory.

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/require.h"
#include "tools/goal_file.h"

namespace interpolated_motion::fuzz {
namespace {

/// A file that goes with its object.
class File {
 public:
  File() : descriptor_(mkstemp(path_)) { require(descriptor_ >= 0, "no file can be made in /tmp"); }
  ~File() { std::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const char* path() const { return path_; }

  void write(const std::string& text) {
    std::FILE* file = std::fopen(path_, "w");
    require(file != nullptr, "the file cannot be written");
    std::fwrite(text.data(), 1, text.size(), file);
    std::fclose(file);
  }

 private:
  char path_[32] = "/tmp/imd_fuzz_goal_XXXXXX";
  int descriptor_;
};

void read(const std::string& text) {
  static File file;
  file.write(text);
  try {
    const auto trajectory = tools::read_goal_file(file.path());
    for (const auto& point : trajectory.points)
      require(std::abs(point.time_from_start.nsec) < 1'000'000'000, "a time that is not normalized");
  } catch (const std::runtime_error& refusal) {
    const std::string reason = refusal.what();
    require(reason.find(file.path()) != std::string::npos, "refused, but the file is not named: " + reason);
  }
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::read(interpolated_motion::fuzz::FuzzInput(data, size).rest());
  return 0;
}
