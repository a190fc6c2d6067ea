#include "interpolated_motion_driver/motion/requests.h"

#include <gtest/gtest.h>

namespace interpolated_motion::motion {
namespace {

bool decided(RequestKind kind, GroupState state, bool& success) {
  Requests requests;
  requests.add(kind);
  requests.settle(state, "the reason");
  const auto result = requests.take_result();
  if (result) success = result->success;
  return result.has_value();
}

TEST(Requests, WaitWhileTheGroupIsOnItsWay) {
  bool success = false;
  for (const auto kind :
       {RequestKind::Enable, RequestKind::Disable, RequestKind::ResetFaults, RequestKind::Halt}) {
    EXPECT_FALSE(decided(kind, GroupState::Stopping, success));
    EXPECT_FALSE(decided(kind, GroupState::Starting, success));
  }
}

TEST(Requests, EnableSucceedsWhenIdleAndFailsInFault) {
  bool success = false;
  ASSERT_TRUE(decided(RequestKind::Enable, GroupState::Idle, success));
  EXPECT_TRUE(success);
  ASSERT_TRUE(decided(RequestKind::Enable, GroupState::Fault, success));
  EXPECT_FALSE(success);
}

TEST(Requests, FailureCarriesTheReason) {
  Requests requests;
  const RequestId id = requests.add(RequestKind::ResetFaults);
  requests.settle(GroupState::Fault, "the reason");
  const auto result = requests.take_result();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->id, id);
  EXPECT_EQ(result->message, "the reason");
  EXPECT_FALSE(requests.take_result());
}

}  // namespace
}  // namespace interpolated_motion::motion
