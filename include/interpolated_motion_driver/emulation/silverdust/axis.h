#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// The axis behind a SilverDust: it follows the target with a first-order lag.
class LaggingAxis {
 public:
  explicit LaggingAxis(const SilverDustPlant& parameters);

  /// One servo tick under control.
  void follow(double target);

  /// One servo tick without: the axis stands.
  void stand() { velocity_ = 0.0; }

  void place(double position);
  void set_stalled(bool stalled) { stalled_ = stalled; }

  /// Following `target`, which stands, changes nothing any more.
  bool settled(double target) const { return stalled_ || position_ == target; }

  double position() const { return position_; }  ///< counts, not wrapped
  double velocity() const { return velocity_; }  ///< counts/tick
  std::int64_t counts() const;                   ///< nearest whole count

 private:
  double gain_;
  bool stalled_ = false;
  double position_ = 0.0;
  double velocity_ = 0.0;
};

}  // namespace interpolated_motion::emulation
