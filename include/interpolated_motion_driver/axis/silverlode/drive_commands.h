#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/silverlode/command_sequence.h"
#include "interpolated_motion_driver/axis/silverlode/silverlode_parameters.h"
#include "interpolated_motion_driver/axis/silverlode/status.h"
#include "interpolated_motion_driver/protocol/silverlode/device_link.h"

namespace interpolated_motion::axis {

/// What bring-up has found out about a SilverLode drive.
struct SilverlodeFacts {
  std::string revision;        ///< the words of its answer to RVN
  bool multi_register = true;  ///< it tells several registers at once
  std::string found_fault;     ///< what its status words told before they were cleared; empty without a fault
};

/// What is sent to a SilverLode drive for what, as steps for the sequence of its commands.
class DriveCommands {
 public:
  using Step = CommandSequence::Step;
  using Steps = std::vector<Step>;

  /// Looks at a drive that is to come to rest; about 12 s on a line at 57600 baud.
  static constexpr int kLooksAtStop = 1000;

  /// All must outlive the commands and the sequence's running.
  DriveCommands(const SilverlodeAxisParameters& parameters, silverlode::DeviceLink& device,
                CommandSequence& sequence, SilverlodeStatus& status)
      : parameters_(parameters), device_(device), sequence_(sequence), status_(status) {}

  /// Stops, identifies, verifies and configures a drive of which nothing is known; `queue` chooses the way
  /// segments take. What is found goes to `facts`.
  Steps bring_up(const Steps& queue, SilverlodeFacts& facts);
  /// Switches the driver on, with the target where the motor stands, so that nothing moves.
  Steps enable();
  /// Switches the motor driver off (DMD).
  Steps disable();
  /// Reads both status words, whose bits are latched; a fault is a failure with its cause. Of the polling
  /// status word, what has been read and is no fault is cleared.
  Steps require_no_fault();
  /// Reads the polling status word, whatever it says.
  Step read_faults();
  /// Ends the interpolated motion on a ramp, on a whole count. Then as empty().
  Steps brake(const Steps& clear_queue, std::int32_t& rest);
  /// What is left in the queue of a drive that stands goes by `clear_queue`; where it stands, to `rest`,
  /// counts.
  Steps empty(const Steps& clear_queue, std::int32_t& rest);

  /// STP on the drive's ramp. `check` as in CommandSequence::Step.
  Step stop(CommandSequence::Check check);
  /// Asks again until the drive has come to rest.
  Step await_rest(int looks_left);
  /// Reads a register into `value`, which must outlive the sequence.
  Step read(std::uint16_t number, std::int32_t& value) const;
  /// Reads register 1 into the status' feedback.
  Step read_position();

  /// Register 19, with which the drive brakes when its queue runs dry; of a stop by command. In its own
  /// units.
  std::int32_t underrun_deceleration() const;
  std::int32_t stop_deceleration() const;

 private:
  Step ask_revision(SilverlodeFacts& facts);
  Step read_polling_status(const CommandSequence::Check& look);
  Step read_internal_status(const CommandSequence::Check& look);
  /// Of a drive that is set up anew: what its status words say is read first, and a fault goes to `facts`.
  Steps read_and_clear_status(SilverlodeFacts& facts);
  Step try_multi_register(SilverlodeFacts& facts);
  Step settle_on_a_count();
  Steps error_limits();
  double counts_per_second2() const;

  const SilverlodeAxisParameters& parameters_;
  silverlode::DeviceLink& device_;
  CommandSequence& sequence_;
  SilverlodeStatus& status_;
};

}  // namespace interpolated_motion::axis
