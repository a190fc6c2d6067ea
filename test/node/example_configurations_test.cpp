#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/node/node_parameters.h"
#include "interpolated_motion_driver/node/robot_description.h"

namespace interpolated_motion::node {
namespace {

const std::string kConfig = IMD_SOURCE_DIR "/config";

std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kConfig))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().stem());
  std::sort(files.begin(), files.end());
  return files;
}

hardware::Configuration load(const std::string& example) {
  const YAML::Node yaml = YAML::LoadFile(kConfig + "/" + example + ".yaml");
  const std::string urdf = yaml["robot_description_file"].as<std::string>();
  const auto description = read_robot_description_file(kConfig + urdf.substr(urdf.rfind("/urdf/")));
  return hardware::parse_configuration(
      yaml, joint_limits(description, yaml["joints"].as<std::vector<std::string>>()), node_parameter_keys());
}

class ExampleConfiguration : public testing::TestWithParam<std::string> {};

TEST_P(ExampleConfiguration, IsTakenWithItsUrdf) { EXPECT_FALSE(load(GetParam()).drives.empty()); }

// What the emulated mechanism is said to be and what the driver takes it for are two statements of one thing.
TEST_P(ExampleConfiguration, SaysOneThingOfItsMechanisms) {
  for (const auto& drive : load(GetParam()).drives) {
    const hardware::Mechanism& mechanism = drive.emulation.mechanism;
    EXPECT_NEAR(mechanism.counts(0.3), drive.transmission.counts(0.3), 0.001) << drive.joint;
    EXPECT_NEAR(mechanism.counts(-0.3), drive.transmission.counts(-0.3), 0.001) << drive.joint;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExampleConfiguration, testing::ValuesIn(examples()),
                         [](const auto& example) { return example.param; });

TEST(ScrewAxes, AreInMetresAsTheUrdfSays) {
  const auto configuration = load("screw_axes");
  EXPECT_EQ(configuration.drives[0].limits.unit, trajectory::JointUnit::Metre);
  EXPECT_EQ(configuration.drives[1].limits.unit, trajectory::JointUnit::Metre);
  EXPECT_EQ(configuration.drives[2].limits.unit, trajectory::JointUnit::Radian);
}

}  // namespace
}  // namespace interpolated_motion::node
