// Commands that inject faults, one a line, into the drives and buses of a whole driver with an emulated drive
// of each kind. The line's first character is the target. What is no command is refused with a reason;
// whatever fails, every order is answered.

#include <array>

#include "fuzz/support/arms.h"
#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/fuzzed_driver.h"
#include "fuzz/support/require.h"

namespace interpolated_motion::fuzz {
namespace {

// By the line's first character: 0..4, and what is no target.
constexpr std::array kTargets{"joint1", "joint2", "joint3", "can0", "line0", "", "joint9"};
constexpr int kLines = 30;  // of the input, at most
constexpr std::size_t kLongestLine = 200;

void run(FuzzInput input) {
  FuzzedDriver arm(arm_of("ecs"));
  arm.bring_up();
  for (int i = 0; i < kLines && !input.empty(); ++i) {
    const auto target = (static_cast<unsigned>(input.byte()) - '0') % kTargets.size();
    std::string reason;
    const bool done = arm.driver().inject(kTargets.at(target), input.line(kLongestLine), &reason, arm.now());
    require(done || !reason.empty(), "refused without a reason");
    if (done && arm.open_goals().empty()) arm.move(0.05, 0.2);
    if (done) arm.run(0.05);
  }
  arm.finish();
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::run(interpolated_motion::fuzz::FuzzInput(data, size));
  return 0;
}
