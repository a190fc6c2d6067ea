#pragma once

#include <string>

#include "simulation/invariant.h"

namespace interpolated_motion::simulation {

/// Every order ends once, in bounded time, with a result that fits it and a cause where it failed.
class OrdersEndOnce : public Invariant {
 public:
  explicit OrdersEndOnce(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "orders end once"; }
  void look(const Look& look) override;
  void wrong_answer(const std::string& why) override { fail(why); }
  void goal_ended(const GoalEntry& goal) override;
  void request_ended(const RequestEntry& request) override;

 private:
  HostTime halted_ = kNever;  ///< when the halt was asked for that has been answered since the last look
};

/// What cannot be driven is refused, and not accepted first.
class RefusedAtOnce : public Invariant {
 public:
  explicit RefusedAtOnce(const Ledger& ledger) : Invariant(ledger) {}

  std::string name() const override { return "refused at once"; }
  void wrongly_accepted(const std::string& why) override { fail("a goal was accepted that " + why); }
};

}  // namespace interpolated_motion::simulation
