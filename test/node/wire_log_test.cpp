#include "interpolated_motion_driver/node/wire_log.h"

#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

canopen::Frame frame(std::uint32_t id, std::vector<std::uint8_t> data) {
  canopen::Frame result;
  result.id = id;
  result.length = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), result.data.begin());
  return result;
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class WireLogFile : public testing::Test {
 protected:
  void SetUp() override { std::remove(path_.c_str()); }
  void TearDown() override { std::remove(path_.c_str()); }

  std::string refusal() const {
    try {
      WireLog log(path_, HostDuration(0), {"can0"});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "opened";
  }

  const std::string path_ = testing::TempDir() + "wire_log_test.log";
};

// The example of can-utils' own manual page of log2asc: "(1436509052.249713) vcan0 044#2A366C2BBA".
TEST(CandumpLine, IsWhatCandumpWrites) {
  const HostDuration time = std::chrono::microseconds(1436509052249713);
  EXPECT_EQ(candump_line("vcan0", frame(0x044, {0x2A, 0x36, 0x6C, 0x2B, 0xBA}), time),
            "(1436509052.249713) vcan0 044#2A366C2BBA\n");
}

TEST(CandumpLine, FillsUpTheMicroseconds) {
  EXPECT_EQ(candump_line("can0", frame(0x80, {}), std::chrono::microseconds(5000042)),
            "(5.000042) can0 080#\n");
}

TEST(SerialLine, ShowsTheDirectionAndEscapesWhatDoesNotPrint) {
  const HostDuration time = std::chrono::microseconds(12000345);
  EXPECT_EQ(serial_line("line0", true, "@16 12 1", time), "(12.000345) line0 > @16 12 1\n");
  EXPECT_EQ(serial_line("line0", false, "# 10 \xFF\x07", time), "(12.000345) line0 < # 10 \\xFF\\x07\n");
}

TEST_F(WireLogFile, TakesFramesAndTextsInTheirOrder) {
  {
    WireLog log(path_, HostDuration(0), {"can0", "line0"});
    log.append("line0", hardware::SerialText{"@16 0", HostTime(std::chrono::seconds(1)), true});
    log.append("can0", canopen::ReceivedFrame{frame(0x80, {}), HostTime(std::chrono::seconds(2)), true});
    log.append("line0", hardware::SerialText{"* 10", HostTime(std::chrono::seconds(3)), false});
    log.append("line0",
               hardware::SerialText{std::string(500, 'x'), HostTime(std::chrono::seconds(4)), false});
  }
  const std::vector<std::string> expected{"(1.000000) line0 > @16 0", "(2.000000) can0 080#",
                                          "(3.000000) line0 < * 10",
                                          "(4.000000) line0 < " + std::string(WireLog::kLongestText, 'x')};
  EXPECT_EQ(lines_of(path_), expected);
}

TEST_F(WireLogFile, GoesOnBehindAnEarlierOne) {
  for (const std::uint32_t id : {0x81U, 0x82U}) {
    WireLog log(path_, HostDuration(0), {"can0"});
    log.append("can0", canopen::ReceivedFrame{frame(id, {}), HostTime(std::chrono::seconds(1)), true});
  }
  EXPECT_EQ(lines_of(path_), (std::vector<std::string>{"(1.000000) can0 081#", "(1.000000) can0 082#"}));
}

TEST_F(WireLogFile, NeverEmptiesWhatIsNoWireLog) {
  for (const char* text :
       {"joints: [joint1]\n", "(5) can0\n", "(.000000) can0\n", "(1.00) can0\n", "(12", "\n"}) {
    std::ofstream(path_) << text;
    EXPECT_NE(refusal().find("Parameter wire_log: " + path_ + " cannot be written: there is"),
              std::string::npos);
    std::ifstream in(path_);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), text);
  }
}

TEST_F(WireLogFile, AFifoWithoutAReaderIsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_NE(refusal().find("it is a FIFO"), std::string::npos);
}

TEST_F(WireLogFile, KeepsTheOrderAndAddsTheOffset) {
  {
    WireLog log(path_, std::chrono::seconds(1000), {"can0", "can1"});
    log.append("can1", canopen::ReceivedFrame{frame(0x181, {0x01}), HostTime(std::chrono::milliseconds(1500)),
                                              false});
    log.append("can0",
               canopen::ReceivedFrame{frame(0x182, {0x02}), HostTime(std::chrono::milliseconds(1501)), true});
    EXPECT_EQ(log.lost(), 0U);
  }
  const std::vector<std::string> expected{"(1001.500000) can1 181#01", "(1001.501000) can0 182#02"};
  EXPECT_EQ(lines_of(path_), expected);
}

TEST_F(WireLogFile, WritesEveryFrameThatIsNotCountedAsLost) {
  constexpr std::size_t kFrames = 100000;
  std::uint64_t lost = 0;
  {
    WireLog log(path_, HostDuration(0), {"can0"});
    for (std::size_t i = 0; i < kFrames; ++i)
      log.append("can0", canopen::ReceivedFrame{frame(0x80, {}), HostTime{}, true});
    lost = log.lost();
  }
  EXPECT_EQ(lines_of(path_).size() + lost, kFrames);
}

TEST_F(WireLogFile, TellsWhereARelativePathIs) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(testing::TempDir());
  const WireLog log("wire_log_test.log", HostDuration(0), {"can0"});
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::path(log.path()).is_absolute()) << log.path();
  EXPECT_TRUE(std::filesystem::equivalent(log.path(), path_)) << log.path();
}

TEST(WireLogOpening, NamesTheFileThatCannotBeWritten) {
  try {
    WireLog log("/nowhere/wire.log", HostDuration(0), {"can0"});
    FAIL() << "opened";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/wire.log"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace interpolated_motion::node
