#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/profile.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"
#include "interpolated_motion_driver/emulation/silverdust/segment_queue.h"

namespace interpolated_motion::emulation {

/// What the interpolated move operation has counted.
struct InterpolationCounters {
  std::uint64_t segments_executed = 0;  ///< loaded into the profile registers, those with time 0 included
  std::uint64_t underruns = 0;          ///< no fresh segment when one was due, the start included
  int minimum_fill = -1;  ///< lowest number of segments waiting in the queue when one was due (0: underrun)
                          ///< and before the one that ends the operation was queued; -1: none was due so far
};

/// The IMS operation ("Interpolated Motion", QCI-TD044): each tick the profile generator makes one step and
/// register 18 counts down; at zero the next segment goes from the queue, or from the four user registers
/// that register 17 names, to registers 18 and 20..23. A segment with time 0 ends the operation after one
/// more tick. When there is no fresh segment, register 19 (in the acceleration scale of IMS; 0 or less: at
/// once) brings the axis to rest, which ends the operation too.
///
/// The operation works on those registers: what is written to them meanwhile is what it goes on with, until
/// the next segment. A time of 0 or less is over in the next tick, a deceleration of 0 or less is the
/// acceleration.
///
/// The document says that the operation ends "instantly", not what becomes of a speed that is left: here the
/// target stands at once.
class InterpolatedMove {
 public:
  /// Works on what it is given, which must outlive it.
  InterpolatedMove(const SilverDustParameters& parameters, RegisterFile& registers, SegmentQueue& queue,
                   ProfileGenerator& profile);

  /// The operation begins in the next tick, which loads the first segment; the first step of the profile is
  /// made in the tick after that.
  void start();

  /// Somebody has written registers 18 or 20..23, which the segment that is executed has been copied to.
  void follow_registers();

  /// Something else has taken over the profile generator.
  void abandon() { phase_ = Phase::Idle; }

  /// From start() to the tick that ends the operation.
  bool active() const { return phase_ != Phase::Idle; }

  /// One servo tick while active.
  void tick();

  /// Ticks since the one that loaded the first segment; -1 before that. Keeps its last value.
  std::int64_t ticks() const { return ticks_; }

  /// Change of velocity per tick in the segment that is executed, fractions of a velocity unit; where its
  /// velocity is constant, that of register 19.
  std::int64_t step() const;

  /// Since the drive was made.
  const InterpolationCounters& counters() const { return counters_; }

 private:
  enum class Phase { Idle, Starting, Running, LastTick, Stopping };

  void load();
  bool fetch(VelocitySegment& segment);
  bool fetch_queued(VelocitySegment& segment);
  bool fetch_registers(std::int64_t first, VelocitySegment& segment);
  void execute(const VelocitySegment& segment);
  void aim();
  std::int64_t step_of(std::int64_t number) const;
  void stop();
  std::int64_t default_step() const;

  int full_scale_;
  RegisterFile& registers_;
  SegmentQueue& queue_;
  ProfileGenerator& profile_;
  Phase phase_ = Phase::Idle;
  std::int64_t ticks_ = -1;
  InterpolationCounters counters_;
};

}  // namespace interpolated_motion::emulation
