#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "interpolated_motion_driver/trajectory/speed_change.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A wish for another speed; what is not given stays.
struct SpeedOrder {
  std::optional<double> override_rate;  ///< 0 .. trajectory::kHighestRate
  std::optional<bool> paused;
};

/// How fast goals are to be gone along: the override, unless they are paused. Both stay as they are from goal
/// to goal, whatever becomes of those.
class SpeedControl {
 public:
  explicit SpeedControl(GoalTime ramp) : ramp_(ramp) {}

  /// Takes the order, or says why not; then nothing has changed.
  std::optional<Refusal> take(const SpeedOrder& order);
  double override_rate() const { return override_; }
  bool is_paused() const { return paused_ || override_ == 0.0; }
  /// What all goals are to be gone along with.
  trajectory::Speed wanted() const { return {is_paused() ? 0.0 : override_, ramp_}; }
  /// Counts the orders that changed it.
  std::uint64_t orders() const { return orders_; }

  /// A sentence for the log, on what has become of an order.
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }
  std::optional<std::string> take_note() {
    if (notes_.empty()) return std::nullopt;
    return take_oldest();
  }

 private:
  std::string take_oldest();

  GoalTime ramp_;
  double override_ = 1.0;
  bool paused_ = false;
  std::uint64_t orders_ = 0;
  std::deque<std::string> notes_;
};

}  // namespace interpolated_motion::motion
