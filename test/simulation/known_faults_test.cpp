#include "simulation/known_faults.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::simulation {
namespace {

// The list may only shrink: whoever cures a fault takes it out and lowers the number.
TEST(KnownFaults, AreNoMoreThanTheyWere) { EXPECT_LE(known_faults().size(), 1U); }

TEST(KnownFaults, AreNamedOnceAndHaveACure) {
  std::set<std::string> names;
  for (const KnownFault& fault : known_faults()) {
    EXPECT_TRUE(names.insert(fault.name).second) << fault.name;
    EXPECT_FALSE(fault.cured_by.empty()) << fault.name;
    EXPECT_FALSE(fault.parts.empty()) << fault.name;
  }
}

TEST(KnownFaults, ExcuseNothingElse) {
  const Violation other{"bounded", 0.0, "a goal was accepted"};
  EXPECT_EQ(find_known(other), nullptr);
}

}  // namespace
}  // namespace interpolated_motion::simulation
