// Goals of arbitrary numbers to a whole driver with one emulated drive of any kind, or with two. A goal that
// is refused moves nothing; one that is accepted keeps the limits at every sample of every drive; each ends
// once.

#include <array>
#include <cmath>

#include "fuzz/support/arms.h"
#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/fuzzed_driver.h"
#include "fuzz/support/require.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr std::array kArms{"e", "c", "s", "es"};
constexpr int kGoals = 6;         // of an input, at most
constexpr unsigned kPoints = 12;  // of a goal, at most
constexpr double kMotion = 0.5;   // s, how long a goal is watched
constexpr double kStill = 1e-3;   // rad: 3 counts of the coarsest encoder, 2000 * 100 a turn
constexpr double kMostTolerance = 1e6;
constexpr double kFarthestStart = 1e6;  // s, before or after now

std::vector<double> bounded(std::vector<double> numbers, double most) {
  for (double& number : numbers)
    if (std::abs(number) > most) number = most;
  return numbers;
}

trajectory::Waypoint read_point(FuzzInput& input, unsigned joints) {
  trajectory::Waypoint point;
  point.time = GoalTime{input.number()};
  const unsigned what = input.byte();
  for (unsigned j = 0; j < joints; ++j) {
    point.positions.push_back(input.number());
    if ((what & 1U) != 0) point.velocities.push_back(input.number());
    if ((what & 2U) != 0) point.accelerations.push_back(input.number());
  }
  if ((what & 0x84U) == 0x84U) point.efforts = input.numbers(3);
  if ((what & 0x88U) == 0x88U) point.positions = input.numbers(3);
  if ((what & 0x90U) == 0x90U) point.velocities = input.numbers(3);
  return point;
}

std::vector<trajectory::JointTolerance> read_tolerances(FuzzInput& input) {
  const auto values = bounded(input.numbers(3), kMostTolerance);
  if (values.size() < 3) return {};
  return {{"joint1", values[0], values[1], values[2]}};
}

trajectory::Goal read_goal(FuzzInput& input, const motion::Snapshot& snapshot, HostTime now) {
  trajectory::Goal goal;
  for (const auto& joint : snapshot.joints) goal.joint_names.push_back(joint.joint);
  const unsigned what = input.byte();
  if (what % 16 == 1) goal.joint_names.push_back("joint1");
  if (what % 16 == 2) goal.joint_names.pop_back();
  if (what % 16 == 3) goal.joint_names.back() = input.text(8);
  if (what % 16 == 4) goal.start = now + host_duration(bounded({input.number()}, kFarthestStart).front());
  if (what % 16 == 5) goal.path_tolerance = read_tolerances(input);
  if (what % 16 == 6) goal.goal_tolerance = read_tolerances(input);
  if (what % 16 == 7) goal.goal_time_tolerance = bounded({input.number()}, kMostTolerance).front();
  const unsigned points = input.below(kPoints + 1);
  for (unsigned i = 0; i < points; ++i)
    goal.points.push_back(read_point(input, static_cast<unsigned>(snapshot.joints.size())));
  return goal;
}

void require_still(FuzzedDriver& arm) {
  const auto before = arm.positions();
  arm.run(0.05);
  const auto after = arm.positions();
  for (std::size_t i = 0; i < before.size(); ++i)
    require(std::abs(after[i] - before[i]) < kStill, "a joint moves, though its goal was refused");
}

void run(FuzzInput input) {
  FuzzedDriver arm(arm_of(kArms.at(input.below(kArms.size()))));
  arm.hold_limits();
  arm.bring_up();
  for (int i = 0; i < kGoals && !input.empty(); ++i) {
    const bool at_rest = arm.open_goals().empty() && arm.snapshot().state == motion::GroupState::Idle;
    const auto refusal = arm.submit(read_goal(input, arm.snapshot(), arm.now()));
    if (refusal && at_rest) require_still(arm);
    if (!refusal) arm.run(kMotion);
  }
  arm.finish();
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::run(interpolated_motion::fuzz::FuzzInput(data, size));
  return 0;
}
