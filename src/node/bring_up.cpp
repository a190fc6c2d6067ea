#include "interpolated_motion_driver/node/bring_up.h"

namespace interpolated_motion::node {

using motion::GroupState;

bool BringUp::update(GroupState state) {
  done_ = done_ || ended_in(state);
  was_enabling_ = was_enabling_ || state == GroupState::Enabling;
  return done_;
}

bool BringUp::ended_in(GroupState state) const {
  switch (state) {
    case GroupState::Starting:
    case GroupState::Enabling:
      return false;
    case GroupState::Disabled:
      return !enable_on_start_ || was_enabling_;
    default:
      return true;
  }
}

}  // namespace interpolated_motion::node
