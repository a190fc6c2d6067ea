#include "simulation/shrinker.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace interpolated_motion::simulation {
namespace {

/// 40 halts, some of them with numbers, on an arm of three joints with settings.
Script long_script() {
  std::string text =
      "configuration {joints: [a, b, c], buses: {can0: {type: canopen, bitrate: 500000}}, drives: {a: {bus: "
      "can0, emulation: "
      "{lag_ms: 5, clock_error_ppm: 3}}, b: {bus: can0}, c: {bus: can0}}, commit_horizon: 0.5}\n";
  for (int i = 0; i < 40; ++i)
    text += "at " + std::to_string(i) + " halt x=1 number=" + std::to_string(i) + "\n";
  return parse_script(text);
}

bool has_number(const Script& script, double number) {
  return std::any_of(script.events.begin(), script.events.end(),
                     [number](const Event& event) { return event.number("number", -1.0) == number; });
}

TEST(Shrunk, ToTheTwoEventsThatMatter) {
  const Script smallest =
      shrunk(long_script(), [](const Script& s) { return has_number(s, 11.0) && has_number(s, 30.0); });
  ASSERT_EQ(smallest.events.size(), 2U);
  EXPECT_EQ(to_text(smallest.events[0]), "at 11 halt number=11");
  EXPECT_EQ(to_text(smallest.events[1]), "at 30 halt number=30");
}

TEST(Shrunk, ToTheJointsAndKeysThatMatter) {
  const Script smallest = shrunk(long_script(), [](const Script& s) {
    const YAML::Node yaml = YAML::Load(s.configuration);
    return yaml["drives"] && yaml["drives"]["a"] && yaml["drives"]["a"]["emulation"] &&
           yaml["drives"]["a"]["emulation"]["lag_ms"] && yaml["buses"];
  });
  const YAML::Node yaml = YAML::Load(smallest.configuration);
  EXPECT_TRUE(smallest.events.empty());
  EXPECT_EQ(yaml["drives"].size(), 1U);
  EXPECT_EQ(yaml["drives"]["a"]["emulation"].size(), 1U);
  EXPECT_FALSE(yaml["commit_horizon"]);
}

TEST(Shrunk, NeverToOneThatDoesNotFail) {
  const auto fails = [](const Script& s) { return s.events.size() >= 7; };
  const Script smallest = shrunk(long_script(), fails);
  EXPECT_EQ(smallest.events.size(), 7U);
}

TEST(Shrunk, WithinItsTries) {
  int tries = 0;
  shrunk(
      long_script(), [&tries](const Script&) { return ++tries < 0; }, 25);
  EXPECT_EQ(tries, 25);
}

}  // namespace
}  // namespace interpolated_motion::simulation
