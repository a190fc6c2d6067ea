#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "simulation/arm.h"
#include "simulation/arm_generator.h"
#include "simulation/goal_maker.h"
#include "simulation/random.h"
#include "simulation/script.h"
#include "simulation/script_generator.h"

namespace interpolated_motion::simulation {
namespace {

// splitmix64 of the seed 0 begins with 0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F,
// 0xF88BB8A8724C81EC (Vigna's splitmix64.c); xoshiro256** of that state gives rotl(5 * second, 7) * 9 first.
TEST(RandomNumbers, AreThoseOfTheAlgorithm) {
  const std::uint64_t second = 0x6E789E6AA1B965F4;
  const std::uint64_t product = second * 5;
  Random random(0);
  EXPECT_EQ(random.next(), ((product << 7) | (product >> 57)) * 9);
}

TEST(RandomNumbers, StayInTheirRangeAndReachItsEnds) {
  Random random(7);
  std::set<int> seen;
  for (int i = 0; i < 10000; ++i) {
    const double number = random.number(-2.0, 3.0);
    ASSERT_GE(number, -2.0);
    ASSERT_LT(number, 3.0);
    seen.insert(random.whole(3, 6));
  }
  EXPECT_EQ(seen, (std::set<int>{3, 4, 5, 6}));
}

TEST(Scripts, OfASeedAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    EXPECT_EQ(to_text(random_script(seed)), to_text(random_script(seed)));
  EXPECT_NE(to_text(random_script(1)), to_text(random_script(2)));
}

TEST(Scripts, AreWhatTheirTextSays) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::string text = to_text(random_script(seed));
    EXPECT_EQ(to_text(parse_script(text)), text);
  }
}

TEST(Scripts, WrongLinesAreNamed) {
  const std::string good = "configuration {}\n";
  for (const char* line :
       {"at", "at x goal", "at 1 goal points", "at 1 goal points=3x", "at 1 inject", "goal at 1"}) {
    try {
      parse_script(good + line);
      FAIL() << line;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(line), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parse_script("at 1 halt"), std::invalid_argument);
}

TEST(Scripts, HaveEveryVerbEveryKindAndNoFaultInHalfOfThem) {
  std::set<std::string> verbs;
  std::set<std::string> kinds;
  int faultless = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Script script = random_script(seed);
    const Arm arm = read_arm(script.configuration);
    const auto is_fault = [&arm](const Event& event) {
      return event.verb == "inject" || event.verb == "die" ||
             (event.verb == "late" && event.number("for") > arm.tolerated_absence());
    };
    for (const Event& event : script.events) verbs.insert(event.verb);
    for (const Joint& joint : arm.joints) kinds.insert(joint.kind);
    if (std::none_of(script.events.begin(), script.events.end(), is_fault)) ++faultless;
  }
  EXPECT_EQ(verbs, (std::set<std::string>{"cancel", "clear", "die", "disable", "enable", "goal", "halt",
                                          "inject", "late", "reset", "speed", "stop", "stream"}));
  EXPECT_EQ(kinds, (std::set<std::string>{"cyclic", "epos_ipm", "silverlode_ims"}));
  EXPECT_GT(faultless, 170);
  EXPECT_LT(faultless, 290);
}

TEST(Arms, OfEachKindHaveItsDrives) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(read_arm(random_arm(random, "epos")).has("cyclic"));
    EXPECT_TRUE(read_arm(random_arm(random, "mixed")).has("silverlode_ims"));
    const Arm all = read_arm(random_arm(random, "all"));
    EXPECT_TRUE(all.has("cyclic") && all.has("epos_ipm") && all.has("silverlode_ims"));
  }
}

TEST(Goals, KeepTheShareOfTheLimitsTheyAreTold) {
  Random random(5);
  const Arm arm = read_arm(random_arm(random, "epos"));
  const std::vector<double> present(arm.joints.size(), 0.1);
  for (int noise = 1; noise <= 200; ++noise) {
    Event event;
    event.verb = "goal";
    event.numbers = {{"points", 60}, {"shape", 2}, {"effort", 0.8}, {"reach", 1.0}, {"noise", noise}};
    const trajectory::Goal goal = make_goal(event, arm, present, HostTime{});
    ASSERT_EQ(goal.points.size(), 60U);
    for (const auto& point : goal.points) {
      for (std::size_t j = 0; j < arm.joints.size(); ++j) {
        EXPECT_LE(std::abs(point.velocities[j]), 0.8 * arm.joints[j].max_velocity * 1.0001);
        EXPECT_LE(std::abs(point.accelerations[j]), 0.8 * arm.joints[j].max_acceleration * 1.0001);
      }
    }
    EXPECT_NEAR(goal.points.back().velocities[0], 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace interpolated_motion::simulation
