// A stream of setpoints of arbitrary numbers at arbitrary times, to a whole driver with one emulated drive of
// any kind or with two, by messages and by write(). The limits are kept at every sample of every drive; the
// arm comes to rest when the stream ends.

#include <array>
#include <cmath>

#include "fuzz/support/arms.h"
#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/fuzzed_driver.h"
#include "fuzz/support/require.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr std::array kArms{"e", "c", "s", "es"};
constexpr int kSetpoints = 60;     // of an input, at most
constexpr double kStep = 0.002;    // s, the unit in which the input waits
constexpr double kFarthest = 1e6;  // s, before or after now
constexpr double kEnd = 3.0;       // s: what docs/setpoints.md lets the arm ride on, brake and linger

HostTime read_time(FuzzInput& input, HostTime now) {
  const double offset = input.number();
  return std::isfinite(offset) && std::abs(offset) < kFarthest ? now + host_duration(offset) : now;
}

motion::Setpoint read_setpoint(FuzzInput& input, const motion::Snapshot& snapshot, HostTime now) {
  const unsigned what = input.byte();
  motion::Setpoint setpoint;
  setpoint.time = (what & 1U) != 0 ? read_time(input, now) : now;
  setpoint.source = (what & 0xC0U) == 0xC0U ? "another" : "fuzz";
  for (const auto& joint : snapshot.joints) {
    setpoint.joint_names.push_back(joint.joint);
    setpoint.positions.push_back(input.number());
    if ((what & 2U) != 0) setpoint.velocities.push_back(input.number());
  }
  if ((what & 0x3CU) == 0x3CU) setpoint.positions = input.numbers(3);
  if ((what & 0x3CU) == 0x1CU) setpoint.joint_names.front() = input.text(8);
  return setpoint;
}

void give(FuzzInput& input, FuzzedDriver& arm) {
  if (input.below(4) != 0) {
    arm.setpoint(read_setpoint(input, arm.snapshot(), arm.now()));
    return;
  }
  for (const auto& joint : arm.driver().joints()) *joint.position_command = input.number();
  arm.write();
}

void run(FuzzInput input) {
  FuzzedDriver arm(arm_of(kArms.at(input.below(kArms.size()))));
  arm.hold_limits();
  arm.bring_up();
  for (int i = 0; i < kSetpoints && !input.empty(); ++i) {
    give(input, arm);
    arm.run(kStep * (1 + input.below(64)));
  }
  const HostTime end = arm.now() + host_duration(kEnd);
  while (arm.snapshot().state != motion::GroupState::Idle && arm.now() < end) arm.run(0.02);
  const motion::GroupState state = arm.snapshot().state;
  require(state == motion::GroupState::Idle,
          std::string("after the stream the group is ") + to_string(state) + " " + arm.snapshot().fault);
  arm.finish();
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::run(interpolated_motion::fuzz::FuzzInput(data, size));
  return 0;
}
