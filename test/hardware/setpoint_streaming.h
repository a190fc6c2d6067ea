#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "interpolated_motion_driver/motion/setpoint.h"

namespace interpolated_motion::test {

/// A group in virtual time that is sent setpoints of a sine, 50 a second, as an operator's device would send
/// them.
class SetpointStreaming : public testing::Test {
 protected:
  static constexpr double kPeriod = 0.020;       // s, of the setpoints
  static constexpr double kAmplitude = 0.2;      // rad
  static constexpr double kAcceleration = 20.0;  // rad/s^2, limit of the arms of scenario.h

  /// How the demand of one drive has moved, from sample to sample of it.
  struct Smoothness {
    double velocity_step = 0.0;  ///< rad/s, greatest from one sample to the next
    double acceleration = 0.0;   ///< rad/s^2, greatest
    double slowest = 1e9;  ///< rad/s, least speed where that of the sine is at least 0.9 of its greatest
  };

  /// `delay`: s that the arm is behind the stream.
  void start(const YAML::Node& parameters, double delay);

  /// 1 Hz, from rest at 0: the sine starts at a crest.
  static double position_at(double time);
  static double velocity_at(double time);
  static motion::Setpoint setpoint(HostTime time, double position);

  std::optional<Refusal> send(const motion::Setpoint& s);
  /// Streams the sine for `duration`; `arrives(k)` tells how late setpoint k comes, s, negative: never.
  void stream(double duration, const std::function<double(int)>& arrives);
  /// The arrivals of a bad network: `lost` of them never come, after the first ones; the others up to half a
  /// period late.
  static std::function<double(int)> with_loss(double lost, unsigned seed);
  void run(double duration);
  /// Called each millisecond.
  virtual void look() {}

  motion::MotionReport report() { return scenario->driver().report(); }

  std::optional<Scenario> scenario;
  HostTime begin{};
  unsigned refused = 0;
  std::vector<Smoothness> smoothness;  ///< of each joint, since start()

 private:
  struct Track {
    double time = -1.0;  ///< s on the drive's clock, of the last sample
    double position = 0.0;
    std::optional<double> velocity;
  };

  void watch(std::size_t joint, const hardware::DemandSample& sample);
  void run_to(HostTime when);

  std::vector<Track> tracks_;
  double delay_ = 0.0;
  bool streaming_ = false;
};

}  // namespace interpolated_motion::test
