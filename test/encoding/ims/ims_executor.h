#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::encoding::testing {

/// When a drive adds its velocity to its position.
enum class Order { VelocityFirst, HalfWay, PositionFirst };

/// A servo drive from the textbook, in counts and ticks and extended precision: shares nothing with the code
/// under test. A segment whose position is near (the projected ones are 2^30 counts away) is one to stop at:
/// the drive brakes when v^2 / 2a reaches the distance left, and the last bit of a count is taken in one
/// step.
class TextbookDrive {
 public:
  TextbookDrive(std::int32_t counts, double counts_per_revolution, Order order)
      : position_(counts),
        per_unit_(counts_per_revolution * 4000 / 60 * 120e-6L / 2147483648.0L),
        order_(order) {}

  void begin(const ImsSegment& segment) {
    const auto present = static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(position_)));
    // Two's complement subtraction wraps around.
    const auto way = static_cast<std::int32_t>(static_cast<std::uint32_t>(segment.position) -
                                               static_cast<std::uint32_t>(present));
    stops_ = std::abs(static_cast<double>(way)) < 1e8 && segment.acceleration != 0;
    target_ = static_cast<long double>(std::llround(position_)) + way;
    if (way != 0) sign_ = way < 0 ? -1 : 1;
    wanted_ = segment.velocity * per_unit_;
    // 2^31 is 2000 rpm per tick, half the weight of the velocity's scale.
    acceleration_ = segment.acceleration / 2.0L * per_unit_;
  }

  void tick() {
    landing_ = false;
    const long double before = velocity_;
    if (acceleration_ > 0) stops_&& must_brake() ? brake() : approach();
    const long double mean = order_ == Order::VelocityFirst   ? velocity_
                             : order_ == Order::PositionFirst ? before
                                                              : (before + velocity_) / 2;
    const long double left = sign_ * (target_ - position_);
    position_ += mean;
    if (stops_ && (left < 0.05L || sign_ * mean >= left) && std::abs(velocity_) < 0.3L) {
      snap_ = std::max(snap_, std::abs(target_ - position_));
      landing_ = velocity_ != 0;
      position_ = target_;
      velocity_ = 0;
      acceleration_ = 0;
    }
  }

  long double position() const { return position_; }  ///< counts, without wrap-around
  long double velocity() const { return velocity_; }  ///< counts/tick
  bool landing() const { return landing_; }           ///< whether the last tick took the last bit of a count
  long double snap() const { return snap_; }          ///< counts, greatest step taken by landing

 private:
  /// Whether holding the velocity for one more tick would leave too little way to brake.
  bool must_brake() const {
    const long double ticks = order_ == Order::VelocityFirst ? 0.5L : order_ == Order::HalfWay ? 1.0L : 1.5L;
    return velocity_ * velocity_ / (2 * acceleration_) >
           sign_ * (target_ - position_) - std::abs(velocity_) * ticks;
  }
  void brake() { velocity_ = sign_ * std::max(0.0L, sign_ * velocity_ - acceleration_); }
  void approach() {
    const long double goal = sign_ * wanted_;
    velocity_ = velocity_ < goal ? std::min(goal, velocity_ + acceleration_)
                                 : std::max(goal, velocity_ - acceleration_);
  }

  long double position_;
  long double per_unit_;
  Order order_;
  long double velocity_ = 0;
  long double target_ = 0;
  long double wanted_ = 0;
  long double acceleration_ = 0;
  long double snap_ = 0;
  int sign_ = 1;
  bool stops_ = false;
  bool landing_ = false;
};

/// What a drive does with segments, compared with the path at every tick.
struct ImsExecution {
  std::int64_t ticks = 0;
  double worst_deviation = 0.0;  ///< counts
  double peak_rpm = 0.0;
  double peak_acceleration = 0.0;  ///< rpm/s
  double end = 0.0;                ///< counts
  double end_velocity = 0.0;       ///< counts/tick
  double snap = 0.0;               ///< counts
  std::vector<double> worst_of_segment;
};

/// Ticks by which a drive is ahead of one that moves as with constant acceleration in between.
inline double ticks_ahead(Order order) {
  return order == Order::VelocityFirst ? 0.5 : order == Order::PositionFirst ? -0.5 : 0.0;
}

/// Executes segments that start at rest at the start of the path, and compares them with the path `ahead`
/// ticks later. `rate`: goal seconds per second of the drive.
inline ImsExecution execute_segments(const std::vector<ImsSegment>& segments, std::int32_t start,
                                     const trajectory::Path& path, const ImsEncoding& encoding,
                                     Order order = Order::HalfWay, double rate = 1.0, double ahead = 0.0) {
  const double resolution = encoding.transmission.counts_per_revolution;
  TextbookDrive drive(start, resolution, order);
  ImsExecution result;
  for (const ImsSegment& segment : segments) {
    drive.begin(segment);
    double worst = 0.0;
    for (std::int32_t i = 0; i < segment.time; ++i) {
      const long double before = drive.velocity();
      drive.tick();
      ++result.ticks;
      const GoalTime time =
          path.start_time() + GoalTime((static_cast<double>(result.ticks) + ahead) * 120e-6 * rate);
      const double wanted = encoding.transmission.counts(time < path.end_time() ? path.sample(time).position
                                                                                : path.final_position());
      worst = std::max(worst, static_cast<double>(std::abs(drive.position() - wanted)));
      const double rpm = static_cast<double>(std::abs(drive.velocity())) / 120e-6 * 60 / resolution;
      result.peak_rpm = std::max(result.peak_rpm, rpm);
      const double change = drive.landing() ? 0.0 : static_cast<double>(std::abs(drive.velocity() - before));
      result.peak_acceleration =
          std::max(result.peak_acceleration, change / 120e-6 / 120e-6 * 60 / resolution);
    }
    result.worst_of_segment.push_back(worst);
    result.worst_deviation = std::max(result.worst_deviation, worst);
  }
  result.end = static_cast<double>(drive.position());
  result.end_velocity = static_cast<double>(drive.velocity());
  result.snap = static_cast<double>(drive.snap());
  return result;
}

inline std::int32_t rounded_start(const trajectory::Path& path, const ImsEncoding& encoding) {
  return static_cast<std::int32_t>(
      std::lround(encoding.transmission.counts(path.sample(path.start_time()).position)));
}

/// 4000 counts per revolution, gear 50:1.
inline ImsEncoding ims_encoding() {
  ImsEncoding encoding;
  encoding.joint = "elbow";
  encoding.transmission = {4000, 50, 1, 0.0};
  encoding.max_motor_rpm = 4000;
  encoding.max_motor_acceleration = 40000;
  return encoding;
}

}  // namespace interpolated_motion::encoding::testing
