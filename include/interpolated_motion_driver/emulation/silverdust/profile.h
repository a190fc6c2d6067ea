#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// The drive's units as ratios of whole numbers, so that nothing is rounded from tick to tick.
///
/// Velocity is held in fractions of a velocity unit, 1/`subdivision` each: fine enough for all acceleration
/// scales to be whole numbers (1 when they are truncated). A speed of one such fraction moves the axis by
/// `advance`/`count` of a count each tick. At 4000 counts per revolution, 4000 rpm and 120 us, 2^31 velocity
/// units are 32 counts per tick: advance 1, count 2^26. At 4096 they are 4096/125 counts per tick: advance 1,
/// count 125 * 2^19.
struct ProfileScale {
  std::int64_t subdivision = 1;  ///< fractions in a velocity unit, 1..4096
  std::int64_t advance = 1;      ///< numerator of counts per tick and fraction
  std::int64_t count = 1;        ///< denominator, without common factor

  /// Throws std::invalid_argument when the ratios do not fit.
  explicit ProfileScale(const SilverDustParameters& parameters);

  /// Change of the velocity in one tick, in fractions. `acceleration`: >= 0; `full_scale`: rpm per tick of
  /// 2^31.
  std::int64_t step(std::int64_t acceleration, int full_scale) const;

  /// A velocity of `units` (2^31: `velocity_full_scale_rpm`) in fractions.
  std::int64_t velocity(std::int64_t units) const { return units * subdivision; }

 private:
  int velocity_full_scale_;
  AccelerationRounding rounding_;
};

/// The trapezoidal profile generator in exact integers, one step a servo tick: towards the commanded position
/// with constant acceleration up to the commanded speed, then at that speed, and, where the position comes
/// within reach, down to rest on it.
///
/// The document says that a segment that comes to a halt ends at its position, not how the generator gets
/// there. Here: each tick takes the highest speed from which braking with the commanded acceleration still
/// ends before the position or on it; that lands exactly, and uses a little more than the commanded
/// acceleration to make up for rounding, at most twice as much. When even that is too little, the axis
/// overshoots and comes back.
class ProfileGenerator {
 public:
  /// At 0, at rest. Throws std::invalid_argument when the scales do not fit.
  explicit ProfileGenerator(const SilverDustParameters& parameters);

  /// Puts the target at `counts`, at rest.
  void place(std::int64_t counts);

  /// Changes of speed, fractions a tick.
  struct Ramps {
    std::int64_t up;    ///< 0: none, neither up nor down
    std::int64_t down;  ///< > 0 unless `up` is 0
  };

  /// Goes to `position` (counts, 32 bit: the nearer way round decides the direction) with speed up to
  /// `velocity` (units, a magnitude). The present speed is kept. Without ramps it goes on at the present
  /// velocity, whatever the position.
  void move_to(std::int32_t position, const Ramps& ramps, std::int64_t velocity);

  /// Ramps to `velocity` (units, signed) and keeps it.
  void run_at(std::int64_t velocity, std::int64_t step);

  /// Ramps to rest; at once when `step` is 0.
  void brake(std::int64_t step);

  /// One servo tick.
  void tick();

  /// At rest, and nothing left to do for the last command.
  bool done() const;

  /// Of the parameters it was made with.
  const ProfileScale& scale() const { return scale_; }
  std::int64_t counts() const { return counts_; }      ///< whole counts of the target, not wrapped
  double position() const;                             ///< target with its fraction, counts, not wrapped
  std::int64_t velocity() const { return velocity_; }  ///< fractions of a velocity unit, signed
  double counts_per_tick() const;                      ///< velocity
  double counts_per_tick_at_full_scale() const;        ///< that of the full scale

 private:
  enum class Command { Stand, MoveTo, RunAt };

  std::int64_t next_velocity(std::int64_t ahead);
  std::int64_t approach(std::int64_t distance, std::int64_t speed) const;
  std::int64_t ramp(std::int64_t speed) const;
  std::int64_t stopping_distance(std::int64_t speed) const;
  std::int64_t remaining() const;
  void move_by(std::int64_t distance);

  ProfileScale scale_;
  Integration integration_;
  Command command_ = Command::Stand;
  std::int32_t goal_ = 0;
  std::int64_t step_ = 0;     ///< up; of RunAt in both directions
  std::int64_t braking_ = 0;  ///< down, of MoveTo
  std::int64_t speed_ = 0;    ///< commanded, fractions; signed for RunAt
  std::int64_t counts_ = 0;
  std::int64_t fraction_ = 0;  ///< halves of 1/`scale_.count`: 0..2 * scale_.count - 1
  std::int64_t velocity_ = 0;
};

}  // namespace interpolated_motion::emulation
