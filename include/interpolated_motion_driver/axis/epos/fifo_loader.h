#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/cia402/power_stage.h"
#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/epos/fifo_watch.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/epos/record_sender.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Reads where a drive's demand is (0x6062) into `counts`, which must outlive the sequence.
SdoSequence::Step read_demand(std::int32_t& counts);
/// Empties a drive's FIFO and closes it.
SdoSequence::Step close_fifo();

/// Fills the FIFO of a drive at rest: emptied, checked where the drive stands, filled, and verified that what
/// was sent got there, since a PDO is not acknowledged by its receiver. What got lost is sent again, with
/// everything else, a few times.
class FifoLoader {
 public:
  /// All must outlive the loader.
  FifoLoader(Cia402PowerStage& stage, const EposAxisParameters& parameters, RecordFeed& feed,
             RecordSender& sender, FifoWatch& watch)
      : stage_(stage), parameters_(parameters), feed_(feed), sender_(sender), watch_(watch) {}

  /// Begins to empty the FIFO; poll() goes on. For an enabled drive at rest that has its mode.
  void begin(HostTime now);
  /// True once the FIFO is filled; a failure is a fault of the power stage.
  bool poll(HostTime now);

 private:
  enum class Step { Clearing, Filling, Verifying };

  void clear(HostTime now);
  void enter(Step step, HostTime now);
  void poll_clearing(HostTime now);
  void poll_filling(HostTime now);
  bool poll_verifying(HostTime now);

  Cia402PowerStage& stage_;
  const EposAxisParameters& parameters_;
  RecordFeed& feed_;
  RecordSender& sender_;
  FifoWatch& watch_;
  Step step_ = Step::Clearing;
  int attempts_ = 0;
  std::int32_t demand_ = 0;  ///< counts, of the drive
  std::uint32_t held_ = 0;   ///< records, by the drive
};

}  // namespace interpolated_motion::axis
