#include <gtest/gtest.h>

#include <string>

#include "host.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"

// The motor's driver and kill motor recovery of the emulated SilverDust, and that no command is left out.
namespace interpolated_motion::emulation {
namespace {

constexpr int kCommandNumbers = 256;

TEST(SilverDustProtection, HaltLeavesTheDriverOnAfterKed) {
  SerialHost host;
  host.expect_ack("182");
  host.expect_ack("15 38650 53687091 0 0");
  host.run(milliseconds(100));
  host.expect_ack("2");
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.status_word("20"), 0x04F3U) << "bit 10: halted";
  host.expect_ack("146");
  const std::int32_t position = host.read(1);
  host.expect_ack("135 400 38650 53687091 0 0");
  host.run(milliseconds(500));
  EXPECT_EQ(host.read(1), position + 400);
  host.expect_ack("183");
  host.expect_ack("2");
  host.take_polling();
  host.expect_ack("135 400 38650 53687091 0 0");
  EXPECT_EQ(host.take_polling() & 0x1000U, 0x1000U) << "command error: the driver is off";
}

TEST(SilverDustProtection, AConditionThatHoldsShutsAnEnabledDriverDownAgain) {
  SerialHost host;
  host.drive->raise_fault(SilverDustFault::OverTemperature, host.world.now());
  EXPECT_EQ(host.take_polling() & 0x0008U, 0x0008U);
  host.expect_ack("228");
  EXPECT_EQ(host.take_polling() & 0x0008U, 0U) << "it is off already";
  host.expect_ack("227");
  EXPECT_EQ(host.take_polling() & 0x0008U, 0x0008U);
  host.expect_ack("163");
  host.expect_ack("227");
  EXPECT_EQ(host.take_polling() & 0x0008U, 0U) << "CIS ends the over-temperature";
}

// A number of the table is never answered with NAK 1, whatever comes of the values; RST with nothing.
TEST(SilverDustProtection, EveryCommandOfTheTableIsKnownToItsChapter) {
  int known = 0;
  for (int number = 0; number < kCommandNumbers; ++number) {
    const CommandInfo* info = find_command(number);
    if (info == nullptr) continue;
    ++known;
    SerialHost host;
    std::string text = std::to_string(number);
    for (std::size_t i = 0; i < info->minimum_parameters; ++i) text += " 1";
    const std::string answer = host.command(text);
    EXPECT_EQ(answer.empty(), info->command == Command::Restart) << number;
    if (!answer.empty() && answer[0] == '!') {
      EXPECT_NE(answer.substr(10), "0001") << number;
    }
  }
  EXPECT_GT(known, 30);
}

}  // namespace
}  // namespace interpolated_motion::emulation
