#include "interpolated_motion_driver/node/fault_trigger.h"

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

using motion::GroupState;

HostTime at(double seconds) { return HostTime{} + host_duration(seconds); }

TEST(FaultTrigger, TellsOnceHalfASecondAfterTheFault) {
  FaultTrigger trigger;
  EXPECT_FALSE(trigger.update(GroupState::Moving, at(1.0)));
  EXPECT_FALSE(trigger.update(GroupState::Fault, at(2.0)));
  EXPECT_TRUE(trigger.is_pending());
  EXPECT_FALSE(trigger.update(GroupState::Fault, at(2.49)));
  EXPECT_TRUE(trigger.update(GroupState::Fault, at(2.5)));
  EXPECT_FALSE(trigger.is_pending());
  EXPECT_FALSE(trigger.update(GroupState::Fault, at(60.0)));
}

TEST(FaultTrigger, AlsoOfAFaultThatWasResetAtOnce) {
  FaultTrigger trigger;
  EXPECT_FALSE(trigger.update(GroupState::Fault, at(2.0)));
  EXPECT_FALSE(trigger.update(GroupState::Disabled, at(2.2)));
  EXPECT_TRUE(trigger.update(GroupState::Disabled, at(2.6)));
}

TEST(FaultTrigger, EachFaultAnew) {
  FaultTrigger trigger;
  trigger.update(GroupState::Fault, at(2.0));
  EXPECT_TRUE(trigger.update(GroupState::Fault, at(3.0)));
  trigger.update(GroupState::Disabled, at(4.0));
  EXPECT_FALSE(trigger.update(GroupState::Fault, at(5.0)));
  EXPECT_TRUE(trigger.update(GroupState::Fault, at(5.5)));
}

}  // namespace
}  // namespace interpolated_motion::node
