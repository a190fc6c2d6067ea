#pragma once

#include <memory>
#include <vector>

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// When a record of a tail may and must cross the bus, as goal time.
struct RecordSlot {
  GoalTime release{0.0};   ///< a place in the FIFO is free from then on
  GoalTime deadline{0.0};  ///< it must be in the FIFO by then
};

/// What a drive is to play, from rest or behind what it is committed to, up to rest: found possible, encoded,
/// none of it sent. A value: what the drive plays meanwhile does not touch it.
struct Tail {
  Tail() = default;
  virtual ~Tail() = default;
  Tail(const Tail&) = delete;
  Tail& operator=(const Tail&) = delete;

  std::vector<RecordSlot> slots;  ///< of its records, for the budget of the bus
};

using TailPtr = std::unique_ptr<Tail>;

/// Everything that encoding for one drive needs, copied when it was made: neither drive nor bus nor clock is
/// asked any more, so tails may be made on any thread.
class TailEncoder {
 public:
  TailEncoder() = default;
  virtual ~TailEncoder() = default;
  TailEncoder(const TailEncoder&) = delete;
  TailEncoder& operator=(const TailEncoder&) = delete;

  /// Executes `path` as the drive will; refused where the drive cannot follow it within its bound. From rest:
  /// a path in goal time that begins where the drive rests. Behind what is committed: the course up to there,
  /// and the way on.
  virtual Expected<TailPtr, Refusal> encode(const trajectory::Path& path) const = 0;
};

using TailEncoderPtr = std::unique_ptr<const TailEncoder>;

/// The tail as a kind of drive has made it. Throws std::bad_cast for one of another kind.
template <class Own, class Any>
Own& own(Any& tail) {
  return dynamic_cast<Own&>(tail);
}

}  // namespace interpolated_motion::axis
