#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/node_link.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/sdo_result.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Reads and writes of a drive's objects, one after the other, each with a look at its outcome.
class SdoSequence {
 public:
  /// Looks at the outcome of a step, successful or not. Returns why the sequence must end, nothing to go on.
  /// May insert steps to be done next.
  using Check = std::function<std::optional<std::string>(const canopen::SdoResult&)>;

  struct Step {
    canopen::ObjectAddress address;          ///< of the read; of a write the same as in `write`
    std::optional<canopen::SdoWrite> write;  ///< empty: a read
    Check check;                             ///< empty: the step must succeed
  };

  /// Idle: nothing has been started, or it was cancelled. Done and Failed last until the next start().
  enum class State { Idle, Running, Done, Failed };

  /// `node` must outlive the sequence, whose SDO client it uses: nobody else may while it runs.
  explicit SdoSequence(canopen::NodeLink& node) : node_(node), timeout_(node.sdo().timeout()) {}

  /// Without `check` the step must succeed.
  static Step read(canopen::ObjectAddress address, Check check = {});
  static Step write(const canopen::SdoWrite& write, Check check = {});

  /// Starts over with `steps`; what was running is given up.
  void start(std::vector<Step> steps, HostTime now);
  /// Puts steps before those still to be done.
  void insert(std::vector<Step> steps);
  /// Puts steps in the place of all those still to be done.
  void replace_rest(std::vector<Step> steps);
  /// Gives up what is left: a transfer under way is aborted, and the sequence is Idle.
  void cancel();

  /// Takes the outcome that has come and begins the next step. A step without an answer is repeated, twice at
  /// most, with more patience each time: the answer may be late instead of lost.
  void poll(HostTime now);
  /// When the drive's answer is overdue; kNever while none is awaited.
  HostTime next_deadline() const;

  /// As of the latest start(), poll() or cancel().
  State state() const { return state_; }
  bool running() const { return state_ == State::Running; }
  /// Why the sequence failed: what was read or written, and how the drive answered.
  const std::string& failure() const { return failure_; }

 private:
  /// Repetitions of a step that got no answer: a frame can get lost.
  static constexpr int kRetries = 2;

  void start_step(HostTime now);
  void finish_step(const canopen::SdoResult& result);

  canopen::NodeLink& node_;
  HostDuration timeout_;  ///< of the first attempt
  std::deque<Step> steps_;
  bool in_progress_ = false;
  int attempts_ = 0;
  State state_ = State::Idle;
  std::string failure_;
};

}  // namespace interpolated_motion::axis
