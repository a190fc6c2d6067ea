#include "interpolated_motion_driver/transport/virtual_serial_line.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace interpolated_motion::transport {
namespace {

struct Listener : SerialListener {
  std::string text;
  std::vector<HostTime> times;
  void on_character(char value, HostTime time) override {
    text.push_back(value);
    times.push_back(time);
  }
};

HostTime at_ns(std::int64_t ns) { return HostTime{} + HostDuration(ns); }
HostTime at_us(std::int64_t us) { return at_ns(us * 1000); }

std::string read_all(SerialLine& line) {
  std::string text;
  while (const auto character = line.receive()) text.push_back(character->value);
  return text;
}

// 10 kbit/s is not a rate of the drives, but its bit of 100 us keeps the arithmetic of the tests in sight: a
// character of 8N2 takes 1100 us.
SerialLineParameters slow(SerialWiring wiring = SerialWiring::Rs485TwoWire) {
  SerialLineParameters parameters;
  parameters.baud = 10'000;
  parameters.wiring = wiring;
  return parameters;
}

struct VirtualSerialLineTest : testing::Test {
  explicit VirtualSerialLineTest(const SerialLineParameters& parameters = slow())
      : line("line0", parameters) {}

  VirtualSerialLine line;
  Listener a;
  Listener b;
  int port_a = line.add_port(a);
  int port_b = line.add_port(b);
};

TEST_F(VirtualSerialLineTest, CharactersFollowEachOtherAtCharacterTime) {
  ASSERT_TRUE(line.host().send("@16\r", at_us(500)));
  line.process(at_us(10'000));
  EXPECT_EQ(a.text, "@16\r");
  EXPECT_EQ(b.text, "@16\r");
  EXPECT_EQ(a.times, (std::vector<HostTime>{at_us(1600), at_us(2700), at_us(3800), at_us(4900)}));
  EXPECT_EQ(read_all(line.host()), "") << "no echo by default";
  EXPECT_EQ(line.statistics().characters, 4U);
}

// 57600 baud 8N2: 11/57600 s = 190972.2 ns a character; 288 characters are 55 ms exactly.
TEST(VirtualSerialLine, CharacterTimesDoNotAddUpTheirRounding) {
  VirtualSerialLine line("line0", SerialLineParameters{});
  Listener drive;
  line.add_port(drive);
  ASSERT_TRUE(line.host().send(std::string(288, 'x'), HostTime{}));
  line.process(at_us(100'000));
  ASSERT_EQ(drive.times.size(), 288U);
  EXPECT_EQ(drive.times.front(), at_ns(190'972));
  EXPECT_EQ(drive.times[1], at_ns(381'944));
  EXPECT_EQ(drive.times.back(), at_us(55'000));
  EXPECT_EQ(line.duration(41), HostDuration(7'829'861));
}

TEST_F(VirtualSerialLineTest, RepliesReachTheHostAndTheOtherDrives) {
  line.send(port_a, "* 10\r", at_us(2000));
  line.process(at_us(1999));
  EXPECT_EQ(line.next_event(), at_us(2000));
  line.process(at_us(20'000));
  const auto first = line.host().receive();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->value, '*');
  EXPECT_EQ(first->time, at_us(3100));
  EXPECT_EQ(read_all(line.host()), " 10\r");
  EXPECT_EQ(a.text, "");
  EXPECT_EQ(b.text, "* 10\r");
  EXPECT_EQ(line.delivered_to_host(), 5U);
}

TEST_F(VirtualSerialLineTest, TheHostIsWokenAtACarriageReturnOrAnIdleLine) {
  line.send(port_a, "* 10\r# 1", at_us(0));
  line.process(at_us(5499));
  EXPECT_EQ(line.host_wakeups(), 0U);
  line.process(at_us(5500));
  EXPECT_EQ(line.host_wakeups(), 1U);
  line.process(at_us(10'999));
  EXPECT_EQ(line.host_wakeups(), 1U);
  line.process(at_us(11'000));  // the last character ended at 8800
  EXPECT_EQ(line.host_wakeups(), 2U);
  EXPECT_EQ(line.next_event(), kNever);
}

TEST_F(VirtualSerialLineTest, TellsWhenTheNextTextEnds) {
  EXPECT_EQ(line.next_text_end(), kNever);
  ASSERT_TRUE(line.host().send("@16 0\r@17", at_us(1000)));
  EXPECT_EQ(line.next_text_end(), at_us(7600)) << "six characters";
  line.process(at_us(7000));
  EXPECT_EQ(line.next_text_end(), at_us(7600)) << "the CR is under way";
  line.process(at_us(7600));
  EXPECT_EQ(line.next_text_end(), at_us(10'900)) << "three characters without a CR";
  line.send(port_a, "* 10\r", at_us(20'000));
  line.process(at_us(10'900));
  EXPECT_EQ(line.next_text_end(), at_us(25'500));
  line.process(at_us(25'500));
  EXPECT_EQ(line.next_text_end(), kNever);
}

TEST_F(VirtualSerialLineTest, SilenceEndsATextWithoutACarriageReturn) {
  line.send(port_a, "# 1", at_us(0));
  line.process(at_us(3300));
  EXPECT_EQ(line.next_text_end(), at_us(5500)) << "two characters of silence";
  line.process(at_us(5500));
  EXPECT_EQ(line.next_text_end(), kNever);
}

// 'U' is 0x55 and on the line, from the start bit on, 0 1010 1010 11; one bit later every bit
// falls on its opposite, so the line is low all the way until the first one stops.
TEST_F(VirtualSerialLineTest, TwoTalkersSpoilEachOther) {
  line.send(port_a, "U", at_us(0));
  line.send(port_b, "U", at_us(100));
  line.process(at_us(10'000));
  EXPECT_EQ(read_all(line.host()), std::string(1, '\0'));
  EXPECT_EQ(line.statistics().collisions, 1U);
}

// 0x0F sends 1111 0000, 0x3C sends 0011 1100: low wherever one is low leaves 0000 1100 reversed, 0x0C.
TEST_F(VirtualSerialLineTest, SimultaneousCharactersAreAnded) {
  line.send(port_a, "\x0F", at_us(0));
  line.send(port_b, "\x3C", at_us(0));
  line.process(at_us(10'000));
  EXPECT_EQ(read_all(line.host()), "\x0C");
  EXPECT_EQ(a.text + b.text, "") << "a talker does not hear the line";
}

TEST_F(VirtualSerialLineTest, EqualRepliesAtTheSameInstantLookLikeOne) {
  line.send(port_a, "* 10\r", at_us(0));
  line.send(port_b, "* 10\r", at_us(0));
  line.process(at_us(20'000));
  EXPECT_EQ(read_all(line.host()), "* 10\r");
  EXPECT_EQ(line.statistics().collisions, 5U);
}

TEST_F(VirtualSerialLineTest, EqualRepliesHalfACharacterApartAreGarbage) {
  line.send(port_a, "* 10\r", at_us(0));
  line.send(port_b, "* 10\r", at_us(500));
  line.process(at_us(20'000));
  const std::string heard = read_all(line.host());
  EXPECT_EQ(heard.find("* 10\r"), std::string::npos);
  EXPECT_FALSE(heard.empty());
}

TEST_F(VirtualSerialLineTest, OnTwoWiresHostAndDriveCollide) {
  ASSERT_TRUE(line.host().send("@17 0\r", at_us(0)));
  line.send(port_a, "* 10\r", at_us(600));
  line.process(at_us(20'000));
  EXPECT_NE(b.text.substr(0, 6), "@17 0\r");
  EXPECT_GT(line.statistics().collisions, 0U);
}

struct MultiDropTest : VirtualSerialLineTest {
  MultiDropTest() : VirtualSerialLineTest(slow(SerialWiring::Rs232MultiDrop)) {}
};

TEST_F(MultiDropTest, DirectionsAreSeparate) {
  ASSERT_TRUE(line.host().send("@17 0\r", at_us(0)));
  line.send(port_a, "* 10\r", at_us(600));
  line.process(at_us(20'000));
  EXPECT_EQ(a.text, "@17 0\r");
  EXPECT_EQ(b.text, "@17 0\r") << "and drives do not hear each other";
  EXPECT_EQ(read_all(line.host()), "* 10\r");
  EXPECT_EQ(line.statistics().collisions, 0U);
}

TEST(VirtualSerialLine, EchoIsHeardByTheHostAlone) {
  SerialLineParameters parameters = slow();
  parameters.echo = true;
  VirtualSerialLine line("line0", parameters);
  Listener drive;
  line.add_port(drive);
  ASSERT_TRUE(line.host().send("@16\r", at_us(0)));
  line.process(at_us(10'000));
  EXPECT_EQ(read_all(line.host()), "@16\r");
  EXPECT_EQ(drive.text, "@16\r");
}

TEST_F(VirtualSerialLineTest, TheHostsBufferIsFinite) {
  SerialLineParameters parameters = slow();
  parameters.host_buffer = 8;
  VirtualSerialLine small("line1", parameters);
  ASSERT_TRUE(small.host().send("12345", at_us(0)));
  EXPECT_FALSE(small.host().send("1234", at_us(0))) << "all or nothing";
  EXPECT_TRUE(small.host().send("123", at_us(0)));
  small.process(at_us(1100));
  EXPECT_TRUE(small.host().send("x", at_us(1100))) << "two characters have left for the line";
}

TEST_F(VirtualSerialLineTest, LostAndGarbledCharacters) {
  line.lose_next(SerialDirection::HostToDrive, 1);
  line.garble_next(SerialDirection::HostToDrive, 1, 0x01);
  ASSERT_TRUE(line.host().send("abc", at_us(0)));
  line.process(at_us(10'000));
  EXPECT_EQ(a.text, "cc") << "a is lost, b (0x62) becomes c (0x63)";
  line.lose_next(SerialDirection::DriveToHost, 2);
  line.send(port_a, "xyz", at_us(10'000));
  line.process(at_us(20'000));
  EXPECT_EQ(read_all(line.host()), "z");
  EXPECT_EQ(line.statistics().lost, 3U);
}

TEST_F(VirtualSerialLineTest, InjectedCharactersTakeTheirTime) {
  line.inject(SerialDirection::DriveToHost, "?!", at_us(1000));
  line.process(at_us(10'000));
  const auto first = line.host().receive();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->time, at_us(2100));
  EXPECT_EQ(read_all(line.host()), "!");
}

TEST_F(VirtualSerialLineTest, AnUnpluggedHostSendsAndHearsNothing) {
  ASSERT_TRUE(line.host().send("@16\r", at_us(0)));
  line.process(at_us(100));
  line.connect(0, false, at_us(100));
  EXPECT_FALSE(line.host().send("@17\r", at_us(100)));
  line.send(port_a, "* 10\r", at_us(2000));
  line.process(at_us(10'000));
  EXPECT_EQ(read_all(line.host()), "");
  EXPECT_EQ(a.text, "@") << "the character under way ends, the others are lost";
  line.connect(0, true, at_us(10'000));
  EXPECT_TRUE(line.host().send("@17\r", at_us(10'000)));
  line.process(at_us(20'000));
  EXPECT_EQ(a.text, "@@17\r");
}

TEST_F(VirtualSerialLineTest, ADisconnectedDriveLosesWhatItHadToSay) {
  line.send(port_a, "* 10\r", at_us(5000));
  line.connect(port_a, false, at_us(0));
  line.process(at_us(20'000));
  EXPECT_EQ(read_all(line.host()), "");
}

TEST_F(VirtualSerialLineTest, TheObserverSeesLinesWithTheirDirection) {
  std::vector<std::string> log;
  line.set_text_observer([&](SerialDirection direction, std::string_view text, HostTime time) {
    const char* arrow = direction == SerialDirection::HostToDrive ? "> " : "< ";
    log.push_back(std::to_string(time.time_since_epoch().count() / 1000) + arrow + std::string(text));
  });
  ASSERT_TRUE(line.host().send("@16 0\r\n", at_us(0)));
  line.send(port_a, "* 10\r", at_us(10'000));
  line.process(at_us(20'000));
  EXPECT_EQ(log, (std::vector<std::string>{"6600> @16 0", "15500< * 10"}));
}

// 500 characters of 1100 us are 550 ms of the first second; 600 more from 0.9 s on are 100 ms of the first,
// 560 ms of the second.
TEST_F(VirtualSerialLineTest, LoadIsTheShareOfEachSecond) {
  ASSERT_TRUE(line.host().send(std::string(500, 'x'), at_us(0)));
  ASSERT_TRUE(line.host().send(std::string(600, 'x'), at_us(900'000)));
  line.process(at_us(1'999'999));
  EXPECT_NEAR(line.statistics().load_last_second, 0.65, 1e-9);
  line.process(at_us(2'000'000));
  EXPECT_NEAR(line.statistics().load_last_second, 0.56, 1e-9);
  line.process(at_us(3'500'000));
  EXPECT_EQ(line.statistics().load_last_second, 0.0);
  EXPECT_NEAR(line.statistics().load_peak, 0.65, 1e-9);
}

TEST(VirtualSerialLine, RefusesImpossibleParameters) {
  SerialLineParameters parameters;
  parameters.baud = 299;
  EXPECT_THROW(VirtualSerialLine("l", parameters), std::invalid_argument);
  parameters.baud = 250'001;
  try {
    VirtualSerialLine line("line0", parameters);
    FAIL() << "250001 baud was taken";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "line line0: baud is 250001, allowed is 300..250000 bit/s");
  }
  parameters = {};
  parameters.bits_per_character = 9;
  EXPECT_THROW(VirtualSerialLine("l", parameters), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::transport
