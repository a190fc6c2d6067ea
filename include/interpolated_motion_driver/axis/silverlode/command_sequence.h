#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/silverlode/device_link.h"
#include "interpolated_motion_driver/protocol/silverlode/outcome.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Commands to a SilverLode drive, one after the other, each with a look at its outcome.
class CommandSequence {
 public:
  /// Looks at the outcome of a step, successful or not. Returns why the sequence must end, nothing to go on.
  /// May insert steps to be done next.
  using Check = std::function<std::optional<std::string>(const silverlode::Outcome&)>;

  struct Step {
    silverlode::Request request;  ///< repeated by the line master as far as it may be
    Check check;                  ///< empty: the drive must accept the command
  };

  /// Idle: nothing has been started, or it was cancelled. Done and Failed last until the next start().
  enum class State { Idle, Running, Done, Failed };

  /// `device` must outlive the sequence; others may have requests of their own on it.
  explicit CommandSequence(silverlode::DeviceLink& device) : device_(device) {}

  /// Starts over with `steps`; what was running is given up.
  void start(std::vector<Step> steps, HostTime now);
  /// Puts steps before those still to be done.
  void insert(std::vector<Step> steps);
  /// Gives up what is left, Idle. A command on the line goes on to its outcome, which take() no longer takes.
  void cancel();

  /// The host was away for so long: that is not the line's fault.
  void excuse(HostDuration away) { waiting_since_ += away; }
  /// Sends the next command, when none is under way and the drive's queue has room.
  void poll(HostTime now);
  /// Takes the outcome if it belongs to this sequence.
  bool take(const silverlode::Outcome& outcome, HostTime now);

  /// As of the latest start(), poll(), take() or cancel().
  State state() const { return state_; }
  bool running() const { return state_ == State::Running; }
  /// Why the sequence failed: what was sent, and how the drive answered.
  const std::string& failure() const { return failure_; }
  /// It failed since a command got no whole reply: it may succeed when it is tried again.
  bool unheard() const { return state_ == State::Failed && unheard_; }

 private:
  /// Repetitions of a command that the drive has not understood: it may have been garbled on its way.
  static constexpr int kRepeats = 2;
  /// Longest wait for an outcome: a line that is unplugged takes no command.
  static constexpr HostDuration kPatience = std::chrono::seconds(3);

  void end(const std::string& failure);

  silverlode::DeviceLink& device_;
  std::deque<Step> steps_;
  silverlode::RequestId awaited_ = silverlode::kNoRequest;
  HostTime waiting_since_{};
  int misunderstood_ = 0;
  State state_ = State::Idle;
  std::string failure_;
  bool unheard_ = false;
};

}  // namespace interpolated_motion::axis
