#include "interpolated_motion_driver/command_line/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/command_line/input_file.h"

namespace interpolated_motion::command_line {
namespace {

namespace fs = std::filesystem;

bool begins_with_a_hash(const std::string& line) { return !line.empty() && line[0] == '#'; }

/// A folder with things in it that nobody must harm, and the ways a file is named.
class OutputFile : public testing::TestWithParam<EarlierFile> {
 protected:
  OutputFile() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~OutputFile() override { fs::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  void put(const char* name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::string content(const char* name) const { return read_text_file(path(name)); }

  void write(const char* name, const std::string& text, EarlierFile earlier) const {
    std::fputs(text.c_str(), open_output_file(path(name), earlier, &begins_with_a_hash).get());
  }

  std::string refusal(const std::string& path) const {
    try {
      open_output_file(path, GetParam(), &begins_with_a_hash);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "opened";
  }

  void expect_refused(const char* name, const std::string& why) const {
    const std::string text = refusal(path(name));
    EXPECT_EQ(text.find(path(name) + " cannot be written: "), 0U) << text;
    EXPECT_NE(text.find(why), std::string::npos) << text;
  }

  const fs::path folder_ = testing::TempDir() + "imd_output_" + std::to_string(getpid());
};

TEST_P(OutputFile, IsMadeWhereThereIsNone) {
  write("new", "#1\n", GetParam());
  EXPECT_EQ(content("new"), "#1\n");
}

TEST_P(OutputFile, AnEmptyOneIsTaken) {
  put("empty", "");
  write("empty", "#1\n", GetParam());
  EXPECT_EQ(content("empty"), "#1\n");
}

TEST_P(OutputFile, OfSomebodyElseIsKept) {
  put("notes", "what I had to say\n");
  expect_refused("notes", "something else in it, which is kept. Name another file");
  EXPECT_EQ(content("notes"), "what I had to say\n");
}

TEST_P(OutputFile, OneLongLineOfSomebodyElseIsKept) {
  put("binary", std::string(100'000, '\0'));
  expect_refused("binary", "something else");
  EXPECT_EQ(content("binary").size(), 100'000U);
}

TEST_P(OutputFile, ASymbolicLinkIsNotFollowed) {
  put("target", "#mine\n");
  fs::create_symlink(path("target"), path("link"));
  expect_refused("link", "symbolic link");
  EXPECT_EQ(content("target"), "#mine\n");
  fs::create_symlink(path("nowhere"), path("dangling"));
  expect_refused("dangling", "symbolic link");
  EXPECT_FALSE(fs::exists(path("nowhere")));
}

// Opening it to write would wait until somebody reads.
TEST_P(OutputFile, AFifoIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  expect_refused("fifo", "a FIFO");
}

TEST_P(OutputFile, FoldersAndDevicesAreRefused) {
  fs::create_directories(path("folder"));
  expect_refused("folder", "a folder");
  EXPECT_NE(refusal("/dev/null").find("a device"), std::string::npos);
  EXPECT_NE(refusal("/nowhere/file").find("No such file or directory"), std::string::npos);
}

TEST_P(OutputFile, GoesOnOnALineOfItsOwnOrIsReplaced) {
  const bool goes_on = GetParam() == EarlierFile::GoOn;
  put("whole", "#1\n#2\n");
  write("whole", "#3\n", GetParam());
  EXPECT_EQ(content("whole"), goes_on ? "#1\n#2\n#3\n" : "#3\n");
  put("broken off", "#1\n#2");
  write("broken off", "#3\n", GetParam());
  EXPECT_EQ(content("broken off"), goes_on ? "#1\n#2\n#3\n" : "#3\n");
}

TEST_P(OutputFile, BeginsAnew) {
  const OpenFile file = open_output_file(path("f"), GetParam(), &begins_with_a_hash);
  std::fputs("#1\n#2\n", file.get());
  begin_anew(file.get(), path("f"));
  std::fputs("#3\n", file.get());
  std::fflush(file.get());
  EXPECT_EQ(content("f"), "#3\n");
}

TEST_P(OutputFile, TakesNoNameThatThereIs) {
  put("there", "");
  fs::create_symlink(path("nowhere"), path("dangling"));
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  for (const char* name : {"there", "dangling", "fifo"}) EXPECT_EQ(create_output_file(path(name)), nullptr);
  EXPECT_FALSE(fs::exists(path("nowhere")));
  EXPECT_NE(create_output_file(path("new")), nullptr);
  EXPECT_THROW(create_output_file("/nowhere/file"), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(EitherWay, OutputFile, testing::Values(EarlierFile::GoOn, EarlierFile::Replace),
                         [](const auto& way) { return way.param == EarlierFile::GoOn ? "GoOn" : "Replace"; });

}  // namespace
}  // namespace interpolated_motion::command_line
