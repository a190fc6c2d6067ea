#include "interpolated_motion_driver/transport/serial_port_line.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>

#include "interpolated_motion_driver/transport/host_clock.h"
#include "interpolated_motion_driver/transport/pseudo_terminal.h"

namespace interpolated_motion::transport {
namespace {

using std::chrono::milliseconds;

/// The rate a tty is set to, bit/s, as the kernel tells it to stty: struct termios2 without its header, which
/// cannot be included beside termios.h. -1: the tty cannot be opened.
int output_rate(const std::string& path) {
  struct Termios2 {
    std::array<std::uint32_t, 4> flags;
    std::uint8_t line;
    std::array<std::uint8_t, 19> characters;
    std::uint32_t input_rate;
    std::uint32_t output_rate;
  };
  constexpr unsigned long kGet = 0x802C542A;  // TCGETS2
  const int fd = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (fd < 0) return -1;
  Termios2 settings{};
  const int result = ioctl(fd, kGet, &settings);
  close(fd);
  return result == 0 ? static_cast<int>(settings.output_rate) : -1;
}

/// A pseudo-terminal under a name that stays, as /dev/serial/by-id gives adapters one.
struct SerialPortLineTest : testing::Test {
  boost::asio::io_context io;
  std::string link = testing::TempDir() + "imd_serial_" + std::to_string(getpid());
  std::unique_ptr<PseudoTerminal> adapter = std::make_unique<PseudoTerminal>(io, link);

  SerialPortParameters parameters() const {
    SerialPortParameters p;
    p.device = link;
    return p;
  }

  std::string read_all(SerialLine& line, std::size_t length) {
    std::string text;
    const HostTime end = read_host_clock() + std::chrono::seconds(10);
    while (text.size() < length && read_host_clock() < end) {
      while (const auto character = line.receive()) text += character->value;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return text;
  }

  bool reaches(SerialPortLine& line, SerialPortState state) {
    const HostTime end = read_host_clock() + std::chrono::seconds(10);
    while (line.state() != state && read_host_clock() < end) {
      line.receive();
      line.poll_port(read_host_clock());
      std::this_thread::sleep_for(milliseconds(5));
    }
    return line.state() == state;
  }
};

TEST_F(SerialPortLineTest, TextsTravelUnchangedBothWays) {
  SerialPortLine line(io, parameters(), read_host_clock());
  ASSERT_EQ(line.state(), SerialPortState::Open) << line.status_text();
  EXPECT_EQ(line.status_text(), link + " is open at 57600 bit/s, 8N2");
  ASSERT_TRUE(line.send("@16 12 1\r", read_host_clock()));
  EXPECT_EQ(read_all(*adapter, 9), "@16 12 1\r");
  const std::string all_control("# 10 000C\r\n\x03\x11\x13\x00\xFF", 16);
  ASSERT_TRUE(adapter->send(all_control, read_host_clock()));
  EXPECT_EQ(read_all(line, all_control.size()), all_control);
  EXPECT_EQ(line.counters().sent, 9U);
  EXPECT_EQ(line.counters().received, all_control.size());
}

TEST_F(SerialPortLineTest, CharactersAreWaitedForByTheLoop) {
  SerialPortLine line(io, parameters(), read_host_clock());
  int calls = 0;
  line.async_wait_readable([&calls](const auto& error) { calls += error ? 100 : 1; });
  io.run_for(milliseconds(30));
  EXPECT_EQ(calls, 0);
  const HostTime before = read_host_clock();
  adapter->send("*", before);
  io.restart();
  io.run_for(milliseconds(2000));
  EXPECT_EQ(calls, 1);
  const auto character = line.receive();
  ASSERT_TRUE(character);
  EXPECT_GE(character->time, before);
  EXPECT_LE(character->time, read_host_clock());
}

// SilverLode: 57600 bit/s, 8 data bits, no parity, 2 stop bits; all rates of its command BRT.
TEST_F(SerialPortLineTest, EveryRateOfTheProtocolIsSet) {
  for (const int baud :
       {300, 1200, 2400, 4800, 9600, 19200, 28800, 38400, 57600, 100'000, 115'200, 230'400, 250'000}) {
    SerialPortParameters p = parameters();
    p.baud = baud;
    SerialPortLine line(io, p, read_host_clock());
    ASSERT_EQ(line.state(), SerialPortState::Open) << baud << ": " << line.status_text();
    if (geteuid() == 0) {  // the port is exclusive, but not for root
      EXPECT_EQ(output_rate(link), baud);
    }
  }
}

TEST_F(SerialPortLineTest, TheFrameFormatIs8N2WithoutFlowControl) {
  const SerialPortLine line(io, parameters(), read_host_clock());
  const int fd = open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);  // root may, others get EBUSY
  if (fd < 0) GTEST_SKIP() << "an exclusive port cannot be looked at";
  termios settings{};
  ASSERT_EQ(tcgetattr(fd, &settings), 0);
  close(fd);
  EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_NE(settings.c_cflag & CSTOPB, 0U);
  EXPECT_EQ(settings.c_cflag & (PARENB | CRTSCTS), 0U);
  EXPECT_EQ(settings.c_iflag & (IXON | IXOFF | ICRNL), 0U);
  EXPECT_EQ(settings.c_lflag & (ICANON | ECHO | ISIG), 0U);
}

TEST_F(SerialPortLineTest, OneProgramOnlyHasThePort) {
  {
    SerialPortLine first(io, parameters(), read_host_clock());
    ASSERT_EQ(first.state(), SerialPortState::Open);
    SerialPortLine second(io, parameters(), read_host_clock());
    EXPECT_EQ(second.state(), SerialPortState::Unusable);
    EXPECT_EQ(second.status_text(),
              link + " is in use by another program: sudo fuser -v " + link + " tells which");
    EXPECT_FALSE(second.send("@16\r", read_host_clock()));
  }
  SerialPortLine third(io, parameters(), read_host_clock());
  EXPECT_EQ(third.state(), SerialPortState::Open) << "the lock ends with the line: " << third.status_text();
}

TEST_F(SerialPortLineTest, UnpluggedAndBackAgain) {
  SerialPortLine line(io, parameters(), read_host_clock());
  EXPECT_TRUE(line.poll_port(read_host_clock())) << "the first state is news";
  EXPECT_FALSE(line.poll_port(read_host_clock()));
  EXPECT_EQ(line.next_deadline(), kNever);
  adapter.reset();
  ASSERT_TRUE(reaches(line, SerialPortState::Missing));
  EXPECT_EQ(line.status_text(), "there is no serial port " + link +
                                    ": plug the adapter in; ls /dev/serial/by-id shows those there are");
  EXPECT_FALSE(line.send("@16\r", read_host_clock()));
  boost::system::error_code told;
  line.async_wait_readable([&told](const auto& error) { told = error; });
  io.restart();
  io.run_for(milliseconds(100));
  EXPECT_EQ(told, boost::asio::error::not_connected);
  EXPECT_LE(line.next_deadline(), read_host_clock() + milliseconds(200));

  adapter = std::make_unique<PseudoTerminal>(io, link);
  ASSERT_TRUE(reaches(line, SerialPortState::Open)) << line.status_text();
  EXPECT_EQ(line.counters().openings, 2U);
  ASSERT_TRUE(line.send("@16 0\r", read_host_clock()));
  EXPECT_EQ(read_all(*adapter, 6), "@16 0\r");
}

TEST_F(SerialPortLineTest, WhatWasLeftFromBeforeIsNotAnAnswer) {
  adapter->send("* 10\r", read_host_clock());
  SerialPortLine line(io, parameters(), read_host_clock());
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_FALSE(line.receive());
}

// A line that nobody reads fills up; what was taken before arrives whole and in order, and nothing twice.
TEST_F(SerialPortLineTest, AFullLineTakesTextsWholeOrNotAtAll) {
  SerialPortLine line(io, parameters(), read_host_clock());
  std::string taken;
  for (int i = 0; i < 100'000; ++i) {
    const std::string text = "@16 " + std::to_string(i) + " 1234567\r";
    if (!line.send(text, read_host_clock())) break;
    taken += text;
  }
  ASSERT_GT(taken.size(), 0U);
  ASSERT_LT(taken.size(), 1'000'000U) << "the line never filled up: nothing was tried";
  std::string seen;
  const HostTime end = read_host_clock() + std::chrono::seconds(10);
  while (seen.size() < taken.size() && read_host_clock() < end) {
    while (const auto character = adapter->receive()) seen += character->value;
    line.poll_port(read_host_clock());
  }
  EXPECT_EQ(seen, taken);
}

TEST_F(SerialPortLineTest, WhatIsNoPortIsExplained) {
  SerialPortParameters p = parameters();
  p.device = "/dev/null";
  EXPECT_EQ(SerialPortLine(io, p, read_host_clock()).status_text(), "/dev/null is not a serial port");
  p.device = "/dev/no_such_port";
  EXPECT_EQ(SerialPortLine(io, p, read_host_clock()).state(), SerialPortState::Missing);
}

TEST_F(SerialPortLineTest, WrongParametersAreRefused) {
  const auto refused = [this](auto change) {
    SerialPortParameters p = parameters();
    change(p);
    EXPECT_THROW(SerialPortLine(io, p, read_host_clock()), std::invalid_argument);
  };
  refused([](auto& p) { p.device = ""; });
  refused([](auto& p) { p.baud = 299; });
  refused([](auto& p) { p.baud = 4'000'001; });
  refused([](auto& p) { p.stop_bits = 3; });
}

TEST_F(SerialPortLineTest, AnAdapterWithoutExtrasIsAdvisedUpon) {
  SerialPortParameters p = parameters();
  p.rs485 = true;
  const SerialPortLine line(io, p, read_host_clock());
  ASSERT_EQ(line.state(), SerialPortState::Open);
  ASSERT_EQ(line.advice().size(), 2U) << "a pseudo-terminal has neither";
  EXPECT_NE(line.advice()[0].find("TIOCSRS485"), std::string::npos);
  EXPECT_NE(line.advice()[1].find("low-latency"), std::string::npos);
}

}  // namespace
}  // namespace interpolated_motion::transport
