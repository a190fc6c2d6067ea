#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host.h"

// The register-based queue of "Interpolated Motion": the data come from user registers that register 17
// names, whether a host or a standalone program writes it.
namespace interpolated_motion::emulation {
namespace {

constexpr int kFirstBlock = 25;

/// The worked example into successive blocks of four registers from 25 on.
void store_worked_example(SerialHost& host) {
  int reg = kFirstBlock;
  for (const std::string& segment : worked_example()) {
    std::size_t begin = 0;
    while (begin < segment.size()) {
      const std::size_t end = std::min(segment.find(' ', begin), segment.size());
      host.expect_ack("11 " + std::to_string(reg++) + " " + segment.substr(begin, end - begin));
      begin = end + 1;
    }
  }
}

bool taken(SerialHost& host) { return (static_cast<std::uint32_t>(host.read(17)) >> 16) == 1; }

// "Store all data in successive blocks of four user registers and construct a loop that iterates the
// appropriate register reference number into the lower word of register 17."
TEST(SilverDustRegisterQueue, AHostCyclesThroughBlocks) {
  SerialHost host;
  host.prepare();
  store_worked_example(host);
  host.expect_ack("11 17 " + std::to_string(kFirstBlock));
  host.expect_ack("253 0 0");
  for (int block = 1; block < 5; ++block) {
    for (int i = 0; i < 200 && !taken(host); ++i) host.run(milliseconds(5));
    ASSERT_TRUE(taken(host));
    EXPECT_EQ(host.read(17) & 0xFFFF, kFirstBlock + 4 * (block - 1)) << "the low word stays";
    host.expect_ack("11 17 " + std::to_string(kFirstBlock + 4 * block));
  }
  host.run(milliseconds(600));
  EXPECT_EQ(host.read(1), 92000);
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.drive->counters().underruns, 0U);
  EXPECT_EQ(host.drive->counters().minimum_fill, -1) << "the queue was not used";
}

// "Import data into the same set of user registers and leave the lower word of register 17 alone."
TEST(SilverDustRegisterQueue, AHostRefillsOneBlock) {
  SerialHost host;
  host.prepare();
  host.expect_ack("11 12 4000");
  host.expect_ack("11 13 1073741824");
  host.expect_ack("11 14 1073742");
  host.expect_ack("11 15 536870912");
  host.expect_ack("11 17 12");
  host.expect_ack("253 0 0");
  const std::vector<std::vector<std::string>> rest = {{"3000", "1073741824", "1073742", "1073741824"},
                                                      {"1000", "1073741824", "1073742", "536870912"},
                                                      {"2000", "92000", "536871", "536870912"},
                                                      {"0", "92000", "536871", "536870912"}};
  for (const auto& segment : rest) {
    for (int i = 0; i < 200 && !taken(host); ++i) host.run(milliseconds(5));
    for (std::size_t k = 0; k < 4; ++k) host.expect_ack("11 " + std::to_string(12 + k) + " " + segment[k]);
    host.expect_ack("11 17 12");
  }
  host.run(milliseconds(600));
  EXPECT_EQ(host.read(1), 92000);
  EXPECT_EQ(host.drive->counters().underruns, 0U);
}

// 1000 rpm after 1000 ticks, then 0.04 counts/tick^2: 4000 + 4000 + 800 counts.
TEST(SilverDustRegisterQueue, AStaleFlagAtTheTimeOutIsAnUnderrun) {
  SerialHost host;
  host.prepare("5368709");
  host.expect_ack("11 12 1500");
  host.expect_ack("11 13 1073741824");
  host.expect_ack("11 14 1073742");
  host.expect_ack("11 15 536870912");
  host.expect_ack("11 17 12");
  host.expect_ack("253 0 0");
  host.run(milliseconds(300));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.drive->counters().underruns, 1U);
  EXPECT_NEAR(host.read(1), 4000 + 4000 + 800, 1);
}

TEST(SilverDustRegisterQueue, TheOperationsOwnRegistersCannotBeTheQueue) {
  SerialHost host;
  host.prepare();
  host.expect_ack("11 17 16");  // 16..19
  host.expect_ack("253 0 0");
  host.run(milliseconds(1));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.drive->counters().underruns, 1U);
}

// The standalone program of the document: start, then write the next block's number whenever one was taken.
TEST(SilverDustRegisterQueue, AProgramOnTheDriveCyclesThroughBlocks) {
  SerialHost host;
  host.prepare();
  store_worked_example(host);
  std::vector<ProgramStep> steps = {ProgramStep::write(17, kFirstBlock), ProgramStep::start()};
  for (int block = 1; block < 5; ++block) {
    steps.push_back(ProgramStep::wait_taken());
    steps.push_back(ProgramStep::write(17, kFirstBlock + 4 * block));
  }
  host.drive->load_program(steps);
  host.expect_ack("10");
  EXPECT_EQ(host.command("254"), "! 10 00FE 0002") << "busy while the program runs";
  host.run(milliseconds(1300));
  EXPECT_EQ(host.read(1), 92000);
  EXPECT_EQ(host.drive->counters().underruns, 0U);
  host.expect_ack("254");
}

TEST(SilverDustRegisterQueue, AProgramOnTheDriveCopiesIntoOneBlock) {
  SerialHost host;
  host.prepare();
  store_worked_example(host);
  std::vector<ProgramStep> steps = {ProgramStep::copy(kFirstBlock, 12, 4), ProgramStep::write(17, 12),
                                    ProgramStep::start()};
  for (int block = 1; block < 5; ++block) {
    steps.push_back(ProgramStep::wait_taken());
    steps.push_back(ProgramStep::copy(kFirstBlock + 4 * block, 12, 4));
    steps.push_back(ProgramStep::write(17, 12));
  }
  host.drive->load_program(steps);
  host.expect_ack("10");
  host.run(milliseconds(1300));
  EXPECT_EQ(host.read(1), 92000);
  EXPECT_EQ(host.drive->counters().underruns, 0U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
