// A configuration as a user writes it. It is refused with a sentence, or it is one that the driver can be
// made of, and that finds its emulated drives without an exception.

#include <algorithm>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/require.h"
#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "simulation/arm.h"

namespace interpolated_motion::fuzz {
namespace {

constexpr std::size_t kMostDrives = 12;  // that are run
constexpr HostDuration kStep = std::chrono::milliseconds(5);
constexpr HostTime kEnd{std::chrono::milliseconds(50)};

std::optional<YAML::Node> load(const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception&) {
    return std::nullopt;
  }
}

std::optional<hardware::Configuration> parse(const YAML::Node& yaml) {
  try {
    return hardware::parse_configuration(yaml, simulation::robot_description());
  } catch (const std::invalid_argument& refusal) {
    const std::string text = refusal.what();
    require(!text.empty() && text.back() == '.', "refused, but not with a sentence: " + text);
    return std::nullopt;
  }
}

/// Other buses are outside of this process.
bool is_emulated(const hardware::BusConfiguration& bus) {
  return bus.transport == hardware::TransportKind::Emulated;
}

void run(const hardware::Configuration& configuration) {
  HostTime now{};
  hardware::MotionHardware driver(configuration, now);
  motion::Snapshot snapshot;
  while (now < kEnd) {
    driver.update(now += kStep);
    driver.snapshot(snapshot);
  }
  require(snapshot.joints.size() == configuration.joints.size(), "a joint has got lost");
}

void read(const std::string& text) {
  const auto yaml = load(text);
  if (!yaml) return;
  const auto configuration = parse(*yaml);
  if (!configuration) return;
  require(!configuration->joints.empty(), "a configuration without joints is taken");
  const auto& buses = configuration->buses;
  if (std::all_of(buses.begin(), buses.end(), is_emulated) && configuration->drives.size() <= kMostDrives)
    run(*configuration);
}

}  // namespace
}  // namespace interpolated_motion::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A text ends at its first NUL, and so would the sentence that repeats it.
  const auto length = static_cast<std::size_t>(std::find(data, data + size, std::uint8_t{0}) - data);
  interpolated_motion::fuzz::read(interpolated_motion::fuzz::FuzzInput(data, length).rest());
  return 0;
}
