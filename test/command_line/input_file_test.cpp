#include "interpolated_motion_driver/command_line/input_file.h"

#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::command_line {
namespace {

class InputFile : public testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  const std::string path_ = testing::TempDir() + "input_file_test.yaml";
};

std::string refusal(const std::string& path) {
  try {
    read_yaml_file(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "read";
}

TEST_F(InputFile, IsRead) {
  write("a: [1, 2]\n");
  EXPECT_EQ(read_yaml_file(path_)["a"][1].as<int>(), 2);
}

TEST_F(InputFile, LongerThanABlockIsReadToItsEnd) {
  write("# " + std::string(100'000, 'x') + "\na: 3\n");
  EXPECT_EQ(read_yaml_file(path_)["a"].as<int>(), 3);
}

TEST_F(InputFile, AnEmptyOneHoldsNothing) {
  write("");
  EXPECT_TRUE(read_yaml_file(path_).IsNull());
}

TEST_F(InputFile, WhyItCannotBeReadIsSaid) {
  EXPECT_EQ(refusal("/nowhere/a.yaml"), "/nowhere/a.yaml cannot be read: No such file or directory");
  EXPECT_EQ(refusal("/"), "/ cannot be read: Is a directory");
}

// Opening it to read would wait until somebody writes.
TEST_F(InputFile, AFifoIsRefusedAndNotWaitedFor) {
  std::remove(path_.c_str());
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(refusal(path_), path_ + " cannot be read: it is a FIFO. Name a file");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero cannot be read: it is a device. Name a file");
}

TEST_F(InputFile, AKeyGivenTwiceIsSaid) {
  write("a: 1\nb:\n  - c: 1\n    d: 2\n    c: 3\n");
  EXPECT_EQ(refusal(path_), path_ + ":5:5: key \"c\" is given twice; leave one of both out");
  write("a: 1\nb: {c: 1}\na: {c: 1}\n");
  EXPECT_EQ(refusal(path_), path_ + ":3:1: key \"a\" is given twice; leave one of both out");
  write("b: [{c: 1}, {c: 1}]\n");
  EXPECT_EQ(refusal(path_), "read");
}

TEST_F(InputFile, WhereItIsNoYamlIsSaid) {
  write("a: 1\nb: [1, 2\nc: 3\n");
  const std::string words = refusal(path_);
  EXPECT_EQ(words.find(path_ + ":3:"), 0U) << words;
}

}  // namespace
}  // namespace interpolated_motion::command_line
