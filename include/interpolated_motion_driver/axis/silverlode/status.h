#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/protocol/silverlode/device_link.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What a SilverLode drive has told about itself, asked bit by bit whenever the line has time for it:
/// positions, the ticks left of a segment, the I/O status word, the polling status word.
class SilverlodeStatus {
 public:
  /// `device` must outlive this. `transmission` makes feedback() of counts. `target_in_motion`: register 0 is
  /// worth reading in motion.
  SilverlodeStatus(silverlode::DeviceLink& device, const encoding::Transmission& transmission,
                   bool target_in_motion)
      : device_(device), transmission_(transmission), target_in_motion_(target_in_motion) {}

  /// Asks the next question. `moving`: what changes in motion is asked more often than what may have happened
  /// at rest.
  void ask(bool moving, bool multi_register, HostTime now);
  /// So many questions are asked in turn in motion, of which one is for the position.
  static int questions_in_motion(bool multi_register) { return multi_register ? 2 : 3; }
  /// Takes the outcome if it belongs to a question of this object.
  bool take(const silverlode::Outcome& outcome);
  /// Takes the actual position from an answer whose first register it is.
  void take_position(const silverlode::Outcome& outcome);
  /// The last question has had no outcome yet.
  bool asking() const { return asked_ != silverlode::kNoRequest; }
  /// Forgets everything but the position: the drive may be another one now, or have restarted.
  void forget();
  /// When the last question was queued; the epoch: never.
  HostTime asked_at() const { return asked_at_; }

  /// At the last bit of the question. The velocity is the difference of two positions less than 0.5 s apart,
  /// else 0. Counts: register 1, as it was read last.
  const AxisFeedback& feedback() const { return feedback_; }
  std::int32_t actual_counts() const { return actual_counts_; }

  silverlode::IoStatus io;            ///< latest answer to RIO; all 0 before the first and after forget()
  HostTime io_time{};                 ///< the drive answered with `io` at this time or later
  silverlode::PollingStatus polling;  ///< latest answer to POL; all 0 before the first and after forget()
  std::optional<std::int32_t> underrun_deceleration;  ///< register 19; lost when the drive restarts
  /// A look at the segment under execution: when, the servo ticks left of it, and what the drive makes of it.
  /// A drive that reads one register at a time tells the ticks alone.
  struct Execution {
    silverlode::Outcome outcome;               ///< of the question, with its times
    std::int32_t ticks_left = 0;               ///< register 18
    std::optional<std::int32_t> position;      ///< counts, register 1
    std::optional<std::int32_t> target;        ///< counts, register 0, where it tells the demand
    std::optional<std::int32_t> acceleration;  ///< register 21, where `target` is not read
    std::optional<std::int32_t> velocity;      ///< register 22, a magnitude
  };
  std::optional<Execution> execution;  ///< the latest, until it is taken
  /// The last question when it got no answer, as text; empty when it got one.
  std::string silence;

 private:
  enum class Question {
    Position,
    PositionAndDeceleration,
    PositionAndExecution,
    Deceleration,
    Ticks,
    Io,
    Polling
  };

  /// Refused questions in a row that are taken for garbled ones.
  static constexpr int kRefusals = 3;

  silverlode::Request request_of(Question question) const;
  void take_answer(const silverlode::Outcome& outcome);
  void take_execution(const silverlode::Outcome& outcome);

  silverlode::DeviceLink& device_;
  encoding::Transmission transmission_;
  bool target_in_motion_;
  silverlode::RequestId asked_ = silverlode::kNoRequest;
  Question question_ = Question::Position;
  std::size_t turn_ = 0;
  int refusals_ = 0;
  HostTime asked_at_{};
  AxisFeedback feedback_;
  std::int32_t actual_counts_ = 0;
};

}  // namespace interpolated_motion::axis
