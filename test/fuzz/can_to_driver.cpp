// Frames of a foreign node on the CAN bus of a whole driver with two emulated drives, and frames that arrive
// otherwise than they were sent, in the bring-up and in motion: whatever they say, every order is answered,
// and nothing is thrown.

#include <array>

#include "fuzz/support/arms.h"
#include "fuzz/support/foreign_node.h"
#include "fuzz/support/fuzzed_orders.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr std::array kArms{"ee", "cc", "ec"};
constexpr int kSteps = 200;       // of the input, at most
constexpr double kTick = 0.0005;  // s, the unit in which the input waits
constexpr unsigned kLongestWait = 64;

class Run {
 public:
  explicit Run(FuzzInput input)
      : input_(input), arm_(arm_of(kArms.at(input_.below(kArms.size())))), node_(*arm_.buses().can) {}

  void operator()() {
    if (input_.below(4) != 0) arm_.bring_up();
    for (int i = 0; i < kSteps && !input_.empty(); ++i) step();
    arm_.finish();
  }

 private:
  void step() {
    switch (input_.below(8)) {
      case 0:
        return arm_.run(kTick * (1 + input_.below(kLongestWait)));
      case 1:
        return give_order(input_, arm_);
      case 2: {
        const unsigned position = input_.byte();
        return node_.spoil_next(position, input_.byte());
      }
      default:
        node_.send(read_frame(input_), arm_.now());
        return arm_.run(kTick);
    }
  }

  FuzzInput input_;
  FuzzedDriver arm_;
  ForeignNode node_;
};

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::Run(interpolated_motion::fuzz::FuzzInput(data, size))();
  return 0;
}
