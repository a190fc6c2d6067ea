// Characters that no drive has sent, and characters lost or spoilt, on the serial line of a whole driver with
// two emulated SilverDust, in the bring-up and in motion: whatever they say, every order is answered, and
// nothing is thrown.

#include "fuzz/support/arms.h"
#include "fuzz/support/fuzzed_orders.h"

namespace interpolated_motion::fuzz {
namespace {

using transport::SerialDirection;

constexpr int kSteps = 200;       // of the input, at most
constexpr double kTick = 0.0005;  // s, the unit in which the input waits
constexpr unsigned kLongestWait = 128;
constexpr std::size_t kLongestText = 64;

void step(FuzzInput& input, FuzzedDriver& arm) {
  transport::VirtualSerialLine& line = *arm.buses().line;
  const unsigned what = input.below(8);
  const auto direction = what % 2 == 0 ? SerialDirection::HostToDrive : SerialDirection::DriveToHost;
  switch (what) {
    case 0:
      return arm.run(kTick * (1 + input.below(kLongestWait)));
    case 1:
      return give_order(input, arm);
    case 2:
    case 3: {
      const int count = input.byte();
      return line.garble_next(direction, count, input.byte());
    }
    case 4:
      return line.lose_next(direction, input.byte());
    default:
      line.inject(direction, input.text(input.below(kLongestText)), arm.now());
  }
}

void run(FuzzInput input) {
  FuzzedDriver arm(arm_of("ss"));
  if (input.below(4) != 0) arm.bring_up();
  for (int i = 0; i < kSteps && !input.empty(); ++i) step(input, arm);
  arm.finish();
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::run(interpolated_motion::fuzz::FuzzInput(data, size));
  return 0;
}
