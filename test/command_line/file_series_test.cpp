#include "interpolated_motion_driver/command_line/file_series.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/command_line/input_file.h"

namespace interpolated_motion::command_line {
namespace {

namespace fs = std::filesystem;

class FileSeriesTest : public testing::Test {
 protected:
  FileSeriesTest() { fs::remove_all(folder_); }
  ~FileSeriesTest() override { fs::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.insert(entry.path().filename());
    return all;
  }

  const fs::path folder_ = testing::TempDir() + "imd_series_" + std::to_string(getpid());
};

TEST_F(FileSeriesTest, MakesTheFolderAndNumbersTheFiles) {
  const FileSeries files(folder_ / "below", "recording_", 3);
  const std::string first = files.write("one");
  EXPECT_EQ(first, (folder_ / "below" / "recording_000001.txt").string());
  EXPECT_EQ(read_text_file(first), "one");
  EXPECT_EQ(fs::path(files.write("two")).filename(), "recording_000002.txt");
}

TEST_F(FileSeriesTest, KeepsTheNewestAndNothingElseIsTouched) {
  const FileSeries files(folder_, "recording_", 2);
  files.write("1");
  for (const char* other : {"recording_.txt", "recording_12.yaml", "recording_a.txt", "notes.txt"})
    std::ofstream(folder_ / other) << "mine";
  for (int i = 2; i <= 5; ++i) files.write(std::to_string(i));
  EXPECT_EQ(names(), (std::set<std::string>{"recording_000004.txt", "recording_000005.txt", "recording_.txt",
                                            "recording_12.yaml", "recording_a.txt", "notes.txt"}));
}

// The numbers go on behind those of an earlier process, whose files stay as they are.
TEST_F(FileSeriesTest, NeverWritesOverAFile) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "recording_000041.txt") << "old";
  fs::create_directories(folder_ / "recording_000042.txt.d");
  const std::string path = FileSeries(folder_, "recording_", 5).write("new");
  EXPECT_EQ(fs::path(path).filename(), "recording_000042.txt");
  EXPECT_EQ(read_text_file((folder_ / "recording_000041.txt").string()), "old");
}

TEST_F(FileSeriesTest, TellsWhyItCannotWrite) {
  std::ofstream(folder_) << "a file, no folder";
  try {
    FileSeries(folder_ / "below", "recording_", 5).write("text");
    FAIL() << "it has written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace interpolated_motion::command_line
