#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/units/time.h"
#include "simulation/ledger.h"

namespace interpolated_motion::simulation {

/// The demand of an emulated drive at one of its samples.
struct Sample {
  HostTime time{};
  std::size_t joint = 0;
  double demand = 0.0;  ///< rad
};

/// What is seen from outside at one look.
struct Look {
  HostTime now{};
  const motion::Snapshot* snapshot = nullptr;      ///< as published
  const std::vector<double>* positions = nullptr;  ///< rad, where the emulated drives really are
  const std::vector<bool>* powers = nullptr;       ///< whether the motors of the emulated drives have power
  bool is_host_there = true;                     ///< false: nothing is published, `snapshot` is what was last
  std::size_t log_lines = 0;                     ///< since the last look
  const motion::MotionReport* report = nullptr;  ///< only where a goal has ended since the last look
};

/// Something that must hold at every sample of every drive, and whenever one looks at the driver. One that
/// has been violated says so once and looks no further.
class Invariant {
 public:
  explicit Invariant(const Ledger& ledger) : ledger_(ledger) {}
  virtual ~Invariant() = default;
  Invariant(const Invariant&) = delete;
  Invariant& operator=(const Invariant&) = delete;

  /// Short, in the words of docs/simulation.md.
  virtual std::string name() const = 0;
  virtual void sample(const Sample&) {}
  virtual void look(const Look&) {}
  /// The group has come to another state, which the ledger knows already.
  virtual void state_change(HostTime) {}
  /// A goal that has to be refused (`why`) has been accepted.
  virtual void wrongly_accepted(const std::string& /*why*/) {}
  /// An answer that the ledger cannot place.
  virtual void wrong_answer(const std::string& /*why*/) {}
  virtual void goal_ended(const GoalEntry&) {}
  virtual void request_ended(const RequestEntry&) {}

  /// It may be violated again.
  void forget() { violation_.reset(); }

  /// One sentence; nothing while it holds.
  const std::optional<std::string>& violation() const { return violation_; }

 protected:
  void fail(std::string sentence) {
    if (!violation_) violation_ = std::move(sentence);
  }
  const Ledger& ledger() const { return ledger_; }
  const Arm& arm() const { return ledger_.arm(); }

 private:
  const Ledger& ledger_;
  std::optional<std::string> violation_;
};

/// All there are, for one simulation.
std::vector<std::unique_ptr<Invariant>> all_invariants(const Ledger& ledger);

/// The group rests, whatever its power stages do.
bool is_at_rest(motion::GroupState state);

}  // namespace interpolated_motion::simulation
