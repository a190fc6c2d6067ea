#pragma once

#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/emulation/silverdust/profile.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"

namespace interpolated_motion::emulation {

/// One velocity segment as the drive holds it, in the order of its four registers.
struct VelocitySegment {
  std::int32_t time = 0;          ///< ticks; 0: last
  std::int32_t position = 0;      ///< counts
  std::int32_t acceleration = 0;  ///< 2^31 is the full scale; 0: constant velocity
  std::int32_t velocity = 0;      ///< 2^31 is the full scale
};

/// The FIFO behind IMQ and IMW.
class SegmentQueue {
 public:
  /// `depth`: segments that can wait, not counting the one that is executed.
  explicit SegmentQueue(int depth) : ring_(static_cast<std::size_t>(depth)) {}

  /// False, and nothing is taken, when the queue is full.
  bool push(const VelocitySegment& segment);

  /// The queue must not be empty.
  VelocitySegment pop();

  int size() const { return static_cast<int>(size_); }

  /// Whether a segment with time 0 is waiting.
  bool holds_end() const;

  void clear() { size_ = 0; }

 private:
  std::vector<VelocitySegment> ring_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
};

/// What the interpolated move operation has counted.
struct InterpolationCounters {
  std::uint64_t segments_executed = 0;  ///< loaded into the profile registers, those with time 0 included
  std::uint64_t underruns = 0;          ///< no fresh segment when one was due, the start included
  int minimum_fill = -1;  ///< lowest number of segments waiting in the queue when one was due (0: underrun)
                          ///< and before the one that ends the operation was queued; -1: none was due so far
};

/// The IMS operation ("Interpolated Motion"): each tick the profile generator makes one step and register 18
/// counts down; at zero the next segment goes from the queue, or from the four user registers that register
/// 17 names, to registers 18 and 20..23. A segment with time 0 ends the operation after one more tick. When
/// there is no fresh segment, register 19 (in the acceleration scale of IMS; 0 or less: at once) brings the
/// axis to rest, which ends the operation too.
///
/// The document says that the operation ends "instantly", not what becomes of a speed that is left: here the
/// target stands at once.
class InterpolatedMove {
 public:
  InterpolatedMove(const SilverDustParameters& parameters, RegisterFile& registers, SegmentQueue& queue,
                   ProfileGenerator& profile);

  /// The operation begins in the next tick, which loads the first segment; the first step of the profile is
  /// made in the tick after that.
  void start();

  /// Something else has taken over the profile generator.
  void abandon() { phase_ = Phase::Idle; }

  /// From start() to the tick that ends the operation.
  bool active() const { return phase_ != Phase::Idle; }

  /// One servo tick while active.
  void tick();

  /// Ticks since the one that loaded the first segment; -1 before that. Keeps its last value.
  std::int64_t ticks() const { return ticks_; }

  const InterpolationCounters& counters() const { return counters_; }

 private:
  enum class Phase { Idle, Starting, Running, LastTick, Stopping };

  void load();
  bool fetch(VelocitySegment& segment);
  bool fetch_queued(VelocitySegment& segment);
  bool fetch_registers(std::int64_t first, VelocitySegment& segment);
  void execute(const VelocitySegment& segment);
  void stop();

  int full_scale_;
  RegisterFile& registers_;
  SegmentQueue& queue_;
  ProfileGenerator& profile_;
  Phase phase_ = Phase::Idle;
  std::int64_t ticks_ = -1;
  InterpolationCounters counters_;
};

}  // namespace interpolated_motion::emulation
