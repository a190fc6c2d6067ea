#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/support/tapped_kind.h"
#include "interpolated_motion_driver/hardware/motion_hardware.h"
#include "simulation/invariants/limits.h"

namespace interpolated_motion::fuzz {

/// The whole driver with emulated drives in virtual time, and what must hold whatever comes from outside: no
/// exception, every order is answered once and in time, what is published is made of numbers and fits
/// together, what is logged is bounded. A Violation is thrown where it does not.
class FuzzedDriver {
 public:
  /// `configuration` is YAML text, as arm_of() writes it.
  explicit FuzzedDriver(const std::string& configuration);
  FuzzedDriver(const FuzzedDriver&) = delete;
  FuzzedDriver& operator=(const FuzzedDriver&) = delete;

  /// From now on the demand of each drive must keep its joint's limits: where nobody but the driver commands
  /// the drives. What the simulation knows by name (simulation/known_faults.cpp) is passed over.
  void hold_limits();

  hardware::MotionHardware& driver() { return *driver_; }
  const motion::Snapshot& snapshot() const { return snapshot_; }
  const Buses& buses() const { return buses_; }
  HostTime now() const { return now_; }
  /// Goals that have been accepted and have not ended.
  const std::set<motion::GoalId>& open_goals() const { return goals_; }
  /// Where the emulated drives stand, rad.
  std::vector<double> positions() const;

  /// Runs for `seconds` of virtual time.
  void run(double seconds);
  /// Runs until the drives have been found and enabled, or could not be.
  void bring_up();
  /// Returns why it was refused.
  std::optional<Refusal> submit(const trajectory::Goal& goal);
  /// As MotionHardware::setpoint(), and as write() with the positions that the handles have.
  std::optional<Refusal> setpoint(const motion::Setpoint& setpoint);
  std::optional<Refusal> write();
  /// A goal that moves all joints by `distance` rad within `seconds`.
  void move(double distance, double seconds);
  /// Cancels every goal.
  void cancel();
  enum class Order { Enable, Disable, Reset, Halt, Clear };
  static constexpr unsigned kOrders = 5;
  void order(Order order);
  /// Halts and shuts down; both must be answered, whatever has become of the drives.
  void finish();

 private:
  std::optional<Refusal> note(std::optional<Refusal> refusal);
  void look();
  void check_limits();
  void take_answers();
  void take_log();
  void check_snapshot() const;
  bool is_answered() const { return goals_.empty() && requests_.empty(); }

  HostTime now_{};
  Buses buses_;
  std::vector<std::unique_ptr<TappedKind>> kinds_;
  simulation::Ledger ledger_;
  simulation::Limits limits_;
  std::unique_ptr<hardware::MotionHardware> driver_;
  motion::Snapshot snapshot_;
  std::set<motion::GoalId> goals_;
  std::set<motion::RequestId> requests_;
  std::size_t log_lines_ = 0;
};

}  // namespace interpolated_motion::fuzz
