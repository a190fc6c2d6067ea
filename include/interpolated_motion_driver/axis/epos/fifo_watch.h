#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/epos/epos_device.h"
#include "interpolated_motion_driver/axis/epos/record_feed.h"
#include "interpolated_motion_driver/axis/epos/record_sender.h"
#include "interpolated_motion_driver/axis/playback_clock.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// How often a drive that cannot tell the fill of its FIFO by a PDO is asked for it.
inline constexpr HostDuration kFifoAskInterval = std::chrono::milliseconds(50);

/// Whether everything that was sent is in a drive's FIFO.
///
/// What is in the FIFO is what was sent and not yet played. How far the drive has played is known within
/// bounds; a fill outside of them means that a record got lost (or one came twice): the drive would cut a
/// corner there. The FIFO is long, so it can be stopped before it gets there. What the fills say about the
/// drive's clock goes to the clock.
class FifoWatch {
 public:
  /// All must outlive the watch.
  FifoWatch(EposDevice& drive, SdoSequence& sequence, const RecordFeed& feed, const RecordSender& sender,
            PlaybackClock& clock)
      : drive_(drive), sequence_(sequence), feed_(feed), sender_(sender), clock_(clock) {}

  /// The FIFO holds `records`, all that were sent, before a motion.
  void filled(std::uint32_t records) { minimum_fill_ = records; }
  /// A motion begins: what was reported before it does not count.
  void begin();
  /// Compares what the drive has reported since. Returns why the motion cannot go on.
  std::optional<std::string> check(HostTime now);

  /// The loader misses `records` that were sent; they count in lost().
  void note_lost(std::uint32_t records) { lost_ += records; }
  std::uint32_t lost() const { return lost_; }                  ///< records, since the start
  std::uint32_t minimum_fill() const { return minimum_fill_; }  ///< while more were to come

 private:
  /// Records that can be in the FIFO by what has been sent and how far the drive can have played.
  struct FillRange {
    std::size_t least;  ///< included
    std::size_t most;   ///< included
    bool contains(std::size_t used) const { return used >= least && used <= most; }
  };

  /// What a drive has told of its FIFO.
  struct Fill {
    std::size_t used = 0;  ///< records
    HostTime from{};       ///< it was so at one instant between these two
    HostTime until{};      ///< of a PDO the same
  };

  std::optional<Fill> reported();
  std::optional<Fill> asked(HostTime now);
  FillRange expected(const Fill& fill) const;
  std::optional<std::string> compare(const Fill& fill);
  void learn_release(const Fill& fill);
  void learn_clock(const Fill& fill);

  EposDevice& drive_;
  SdoSequence& sequence_;
  const RecordFeed& feed_;
  const RecordSender& sender_;
  PlaybackClock& clock_;
  std::uint64_t reports_taken_ = 0;
  int mismatches_ = 0;
  int taken_early_ = 0;  ///< reports in a row that say so, see learn_release()
  HostTime asked_{};
  std::optional<std::uint32_t> answer_;  ///< records used, when the drive was asked last
  std::uint32_t lost_ = 0;
  std::uint32_t minimum_fill_ = 0;
};

}  // namespace interpolated_motion::axis
