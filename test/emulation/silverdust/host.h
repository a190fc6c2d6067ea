#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::emulation {

inline HostDuration milliseconds(double value) { return host_duration(value * 1e-3); }

/// The document's worked example: time, position, acceleration and velocity of its segments, the last with
/// time 0.
inline const std::vector<std::string>& worked_example() {
  static const std::vector<std::string> segments = {
      "4000 1073741824 1073742 536870912", "3000 1073741824 1073742 1073741824",
      "1000 1073741824 1073742 536870912", "2000 92000 536871 536870912", "0 92000 536871 536870912"};
  return segments;
}

/// A host that knows its drives only by what is on the line, and a world with one line for it.
class SerialHost {
 public:
  explicit SerialHost(const SilverDustParameters& parameters = {},
                      const transport::SerialLineParameters& line_parameters = {})
      : line(world.add_serial_line("line0", line_parameters)) {
    drive = &world.add<SilverDust>(line, parameters);
    address = parameters.address;
    line.set_text_observer(
        [this](transport::SerialDirection direction, std::string_view text, HostTime time) {
          const char* arrow = direction == transport::SerialDirection::HostToDrive ? " > " : " < ";
          log.push_back(std::to_string(time.time_since_epoch().count()) + arrow + std::string(text));
        });
  }

  void run(HostDuration length) {
    const HostTime end = world.now() + length;
    while (world.now() < end) {
      world.advance(end);
      while (const auto character = world.serial_line("line0").receive()) heard.push_back(character->value);
    }
  }

  /// Everything heard since the last call, CR as '|'.
  std::string take() {
    std::string text;
    text.swap(heard);
    for (char& c : text) c = c == '\r' ? '|' : c;
    return text;
  }

  void say(const std::string& text) { ASSERT_TRUE(world.serial_line("line0").send(text, world.now())); }

  /// What is heard within 40 ms after `text` and a CR, CR as '|'; empty when there is no answer.
  std::string ask(const std::string& text) {
    run(milliseconds(0.2));
    heard.clear();
    say(text + "\r");
    const HostTime limit = world.now() + milliseconds(40);
    while (world.now() < limit && heard.find('\r') == std::string::npos) {
      world.advance(limit);
      while (const auto character = world.serial_line("line0").receive()) heard.push_back(character->value);
    }
    return take();
  }

  /// `ask` without the '@', the address and the '|' at the end: "1 65535" -> "* 10".
  std::string command(const std::string& text) {
    std::string answer = ask("@" + std::to_string(address) + " " + text);
    if (!answer.empty() && answer.back() == '|') answer.pop_back();
    return answer;
  }

  void expect_ack(const std::string& text) {
    char ack[8];
    std::snprintf(ack, sizeof ack, "* %02X", static_cast<unsigned>(address));
    ASSERT_EQ(command(text), ack) << text;
  }

  std::int32_t read(int reg) {
    const std::string answer = command("12 " + std::to_string(reg));
    unsigned a = 0;
    unsigned high = 0;
    unsigned low = 0;
    EXPECT_EQ(std::sscanf(answer.c_str(), "# %2X 000C %4X %4X", &a, &high, &low), 3) << answer;
    return static_cast<std::int32_t>(high << 16 | low);
  }

  unsigned status_word(const std::string& read_command) {
    const std::string answer = command(read_command);
    unsigned a = 0;
    unsigned echo = 0;
    unsigned value = 0;
    EXPECT_EQ(std::sscanf(answer.c_str(), "# %2X %4X %4X", &a, &echo, &value), 3) << answer;
    return value;
  }

  bool trajectory_active() { return (status_word("21") & 0x0008) != 0; }

  /// Bits of the polling status word, reported and then cleared.
  unsigned take_polling() {
    const unsigned word = status_word("27");
    expect_ack("1 65535");
    return word;
  }

  /// Queue mode with an empty queue, and nothing left in the polling status word.
  void prepare(const std::string& deceleration = "1073742") {
    expect_ack("11 17 0");
    expect_ack("11 19 " + deceleration);
    expect_ack("254");
    take_polling();
  }

  void queue(const std::string& segment) { expect_ack("25 " + segment); }

  void observe() {
    drive->set_sample_observer([this](const SilverDustSample& sample) { samples.push_back(sample); });
  }

  /// The sample `ticks` after the start of the interpolation.
  const SilverDustSample& sample_at(std::int64_t ticks) const {
    for (const auto& sample : samples) {
      if (sample.interpolating && sample.ticks_since_start == ticks) return sample;
    }
    ADD_FAILURE() << "no sample " << ticks;
    static const SilverDustSample none;
    return none;
  }

  World world;
  transport::VirtualSerialLine& line;
  SilverDust* drive = nullptr;
  int address = 16;
  std::string heard;
  std::vector<std::string> log;
  std::vector<SilverDustSample> samples;
};

}  // namespace interpolated_motion::emulation
