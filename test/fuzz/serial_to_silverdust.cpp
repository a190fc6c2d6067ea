// Characters to an emulated SilverDust, as any host might send them. Whatever it was told, it answers with
// printable characters, its demand is a number, and switched off and on it answers again.

#include <cctype>
#include <cmath>

#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/require.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr int kLines = 300;                                     // of the input, at most
constexpr std::size_t kLongestLine = 100;                       // characters
constexpr HostDuration kTick = std::chrono::microseconds(500);  // the unit in which the input waits
constexpr HostDuration kBootTime = std::chrono::milliseconds(5);
constexpr HostDuration kBoot = std::chrono::milliseconds(50);
constexpr HostDuration kAnswer = std::chrono::milliseconds(100);

emulation::SilverDustParameters quick_to_boot() {
  emulation::SilverDustParameters parameters;
  parameters.boot_time = kBootTime;
  return parameters;
}

class Run {
 public:
  explicit Run(FuzzInput input)
      : input_(input),
        line_(world_.add_serial_line("line0")),
        drive_(world_.add<emulation::SilverDust>(line_, quick_to_boot())) {}

  void operator()() {
    if (input_.below(2) == 1) {
      drive_.observe([](const emulation::DemandSample& sample) {
        require(std::isfinite(sample.demand), "the demand is no number");
      });
    }
    for (int i = 0; i < kLines && !input_.empty(); ++i) {
      const unsigned ticks = input_.byte();
      world_.serial_line("line0").send(input_.line(kLongestLine) + "\r", world_.now());
      run(ticks * kTick);
    }
    drive_.power_cycle(world_.now(), std::chrono::milliseconds(10));
    run(kBoot);
    answer_.clear();
    world_.serial_line("line0").send("@16 0\r", world_.now());  // POL
    run(kAnswer);
    require(!answer_.empty() && answer_.back() == '\r', "it does not answer");
  }

 private:
  void run(HostDuration duration) {
    const HostTime end = world_.now() + duration;
    while (world_.now() < end) {
      world_.advance(end);
      while (const auto received = world_.serial_line("line0").receive()) take(received->value);
    }
  }

  void take(char value) {
    require(value == '\r' || std::isprint(static_cast<unsigned char>(value)) != 0, "it says what is no text");
    answer_ += value;
  }

  FuzzInput input_;
  emulation::World world_;
  transport::VirtualSerialLine& line_;
  emulation::SilverDust& drive_;
  std::string answer_;
};

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::Run(interpolated_motion::fuzz::FuzzInput(data, size))();
  return 0;
}
