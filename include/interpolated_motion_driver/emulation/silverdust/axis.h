#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// The axis behind a SilverDust: it follows the target with a first-order lag.
class LaggingAxis {
 public:
  /// At 0, at rest, free.
  explicit LaggingAxis(const SilverDustPlant& parameters);

  /// One servo tick under control. `target`: counts, not wrapped.
  void follow(double target);

  /// One servo tick without: the axis stands.
  void stand() { velocity_ = 0.0; }

  /// Puts it at `position`, counts, at rest.
  void place(double position);

  /// True: it stands, whatever the target.
  void set_stalled(bool stalled) { stalled_ = stalled; }

  /// Following `target`, which stands, changes nothing any more.
  bool settled(double target) const { return stalled_ || position_ == target; }

  double position() const { return position_; }  ///< counts, not wrapped
  double velocity() const { return velocity_; }  ///< counts/tick
  std::int64_t counts() const;                   ///< nearest whole count, not wrapped
  std::int32_t reading() const;                  ///< counts, as 32 bits of the encoder's counter show them

 private:
  double gain_;
  bool stalled_ = false;
  double position_ = 0.0;
  double velocity_ = 0.0;
};

}  // namespace interpolated_motion::emulation
