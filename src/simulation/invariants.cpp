#include "simulation/invariant.h"
#include "simulation/invariants/accepted_is_held.h"
#include "simulation/invariants/bounded.h"
#include "simulation/invariants/braking.h"
#include "simulation/invariants/fault_holds.h"
#include "simulation/invariants/limits.h"
#include "simulation/invariants/off_is_off.h"
#include "simulation/invariants/on_course.h"
#include "simulation/invariants/orders_end_once.h"
#include "simulation/invariants/published_is_true.h"
#include "simulation/invariants/still_without_order.h"
#include "simulation/invariants/stops_together.h"

namespace interpolated_motion::simulation {

namespace {

template <class... Kinds>
std::vector<std::unique_ptr<Invariant>> make(const Ledger& ledger) {
  std::vector<std::unique_ptr<Invariant>> invariants;
  (invariants.push_back(std::make_unique<Kinds>(ledger)), ...);
  return invariants;
}

}  // namespace

std::vector<std::unique_ptr<Invariant>> all_invariants(const Ledger& ledger) {
  return make<Limits, Braking, StillWithoutOrder, FaultHolds, OffIsOff, StopsTogether, OrdersEndOnce,
              RefusedAtOnce, AcceptedIsHeld, OnCourse, PublishedIsTrue, DesiredIsSmooth, Bounded>(ledger);
}

bool is_at_rest(motion::GroupState state) {
  using motion::GroupState;
  return state == GroupState::Starting || state == GroupState::Disabled || state == GroupState::Enabling ||
         state == GroupState::Idle || state == GroupState::Standing || state == GroupState::Fault;
}

}  // namespace interpolated_motion::simulation
