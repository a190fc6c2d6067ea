#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/silverlode/power_stage.h"
#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/axis/silverlode/segment_feed.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Loads a drive at rest: its queue is emptied, it is looked whether it stands where it was planned from and
/// has kept its settings, and its first segment, one of waiting, is put into the queue.
class SegmentLoader {
 public:
  /// All must outlive the loader.
  SegmentLoader(SilverlodePowerStage& stage, SegmentFeed& feed, SegmentDelivery& delivery)
      : stage_(stage), feed_(feed), delivery_(delivery) {}

  /// `rest_counts`: where the drive was planned from.
  void begin(std::int32_t rest_counts, HostTime now);
  /// True once the drive is loaded; a failure is a fault of the power stage.
  bool poll(HostTime now);

 private:
  void poll_clearing(HostTime now);

  SilverlodePowerStage& stage_;
  SegmentFeed& feed_;
  SegmentDelivery& delivery_;
  bool cleared_ = false;
  std::int32_t rest_counts_ = 0;
  std::int32_t target_ = 0;        ///< register 0 and
  std::int32_t deceleration_ = 0;  ///< register 19 as the drive has them
};

}  // namespace interpolated_motion::axis
