#include "interpolated_motion_driver/node/bring_up.h"

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

using motion::GroupState;

TEST(BringUp, WaitsUntilTheDrivesAreEnabled) {
  BringUp bring_up(true);
  EXPECT_FALSE(bring_up.update(GroupState::Starting));
  EXPECT_FALSE(bring_up.update(GroupState::Disabled));
  EXPECT_FALSE(bring_up.update(GroupState::Enabling));
  EXPECT_TRUE(bring_up.update(GroupState::Idle));
}

TEST(BringUp, IsDoneWithTheDrivesOffWhenTheyAreNotToBeEnabled) {
  BringUp bring_up(false);
  EXPECT_FALSE(bring_up.update(GroupState::Starting));
  EXPECT_TRUE(bring_up.update(GroupState::Disabled));
}

TEST(BringUp, EndsInAFault) {
  BringUp bring_up(true);
  EXPECT_FALSE(bring_up.update(GroupState::Starting));
  EXPECT_TRUE(bring_up.update(GroupState::Fault));
}

TEST(BringUp, EndsWhenTheDrivesAreDisabledAgain) {
  BringUp bring_up(true);
  EXPECT_FALSE(bring_up.update(GroupState::Enabling));
  EXPECT_TRUE(bring_up.update(GroupState::Disabled));
}

TEST(BringUp, HappensOnce) {
  BringUp bring_up(true);
  EXPECT_TRUE(bring_up.update(GroupState::Idle));
  EXPECT_TRUE(bring_up.update(GroupState::Starting));
}

}  // namespace
}  // namespace interpolated_motion::node
