// A robot description, as its limits are read.

#include <cmath>
#include <stdexcept>

#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/require.h"
#include "interpolated_motion_driver/node/robot_description.h"

namespace interpolated_motion::fuzz {
namespace {

void require_sound(const trajectory::JointLimits& limits) {
  require(limits.max_velocity > 0.0, "a velocity limit that is not above 0 is taken");
  require(limits.max_acceleration > 0.0, "an acceleration limit that is not above 0 is taken");
  require(limits.continuous || limits.min_position < limits.max_position,
          "position limits without room are taken");
}

void read(const std::string& urdf) {
  try {
    const auto limits = node::joint_limits({urdf, "the URDF"}, {"joint1", "joint2"});
    require(limits.size() == 2, "a joint has got lost");
    for (const auto& [joint, of_joint] : limits) require_sound(of_joint);
  } catch (const std::invalid_argument& refusal) {
    require(*refusal.what() != '\0', "refused without a reason");
  }
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  interpolated_motion::fuzz::read(interpolated_motion::fuzz::FuzzInput(data, size).rest());
  return 0;
}
