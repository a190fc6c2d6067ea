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
    canopen::ObjectAddress address;
    std::optional<canopen::SdoWrite> write;  ///< empty: a read
    Check check;                             ///< empty: the step must succeed
  };

  enum class State { Idle, Running, Done, Failed };

  explicit SdoSequence(canopen::NodeLink& node) : node_(node) {}

  static Step read(canopen::ObjectAddress address, Check check = {});
  static Step write(const canopen::SdoWrite& write, Check check = {});

  /// Starts over with `steps`; what was running is given up.
  void start(std::vector<Step> steps, HostTime now);
  /// Puts steps before those still to be done.
  void insert(std::vector<Step> steps);
  /// Puts steps in the place of all those still to be done.
  void replace_rest(std::vector<Step> steps);
  void cancel();

  void poll(HostTime now);
  HostTime next_deadline() const;

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
  std::deque<Step> steps_;
  bool in_progress_ = false;
  int attempts_ = 0;
  State state_ = State::Idle;
  std::string failure_;
};

}  // namespace interpolated_motion::axis
