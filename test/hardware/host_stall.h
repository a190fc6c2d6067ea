#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/can_link.h"

namespace interpolated_motion::test {

/// One axis and one emulated drive on a CAN bus. When the host stalls the world goes on, and nobody polls
/// axis and bus.
class HostStall : public testing::Test {
 protected:
  static constexpr double kCounts = 1e5 / (2.0 * 3.14159265358979324);  // per rad

  explicit HostStall(const hardware::BusConfiguration& bus) : link(bus, bus_.host()) {}

  /// From rest at 0 to 1 rad/s at 0.5 rad within a second, straight on for another, and to rest at 2 rad
  /// within a third: the velocity rises as 3 t^2 - 2 t^3.
  static trajectory::Path there() {
    const trajectory::Polynomial speed_up{{0.0, 0.0, 0.0, 1.0, -0.5, 0.0}};
    const trajectory::Polynomial cruise{{0.5, 1.0, 0.0, 0.0, 0.0, 0.0}};
    const trajectory::Polynomial slow_down{{1.5, 1.0, 0.0, -1.0, 0.5, 0.0}};
    const auto s = [](double t) { return GoalTime{t}; };
    return trajectory::Path({{s(0), s(1), speed_up}, {s(1), s(2), cruise}, {s(2), s(3), slow_down}});
  }

  static hardware::BusConfiguration bus_configuration(bool isochronous) {
    hardware::BusConfiguration bus;
    bus.name = "can0";
    bus.isochronous = isochronous;
    return bus;
  }

  template <class Parameters>
  static Parameters drive_parameters() {
    Parameters p;
    p.node_id = 1;
    return p;
  }

  template <class Parameters>
  static Parameters axis_parameters() {
    Parameters p;
    p.joint = "elbow";
    p.transmission.counts_per_revolution = 2000.0;
    p.transmission.ratio = 50.0;
    p.limits.max_velocity = 2.0;
    p.limits.max_acceleration = 10.0;
    p.limits.min_position = -3.0;
    p.limits.max_position = 3.0;
    return p;
  }

  HostTime now() const { return world_.now(); }

  void step(HostTime limit) {
    world_.advance(limit);
    link.receive({});
    link.poll(now());
    axis_->poll(now());
    link.send(now());
  }

  bool run_until(const std::function<bool()>& condition, double most = 5.0) {
    const HostTime end = now() + host_duration(most);
    while (!condition() && now() < end)
      step(std::min(end, std::max(link.next_deadline(), now() + std::chrono::microseconds(50))));
    return condition();
  }

  bool comes_to(axis::AxisState state) {
    return run_until([&] { return axis_->state() == state; });
  }

  void run(double duration) {
    run_until([] { return false; }, duration);
  }

  void stall(HostDuration duration) {
    const HostTime end = now() + duration;
    while (now() < end) world_.advance(end);
  }

  /// Brings the axis up and loads a path.
  void prepare(axis::Axis& axis, const trajectory::Path& path) {
    axis_ = &axis;
    axis.bring_up(now());
    ASSERT_TRUE(comes_to(axis::AxisState::Disabled)) << axis.fault_text();
    axis.enable(now());
    ASSERT_TRUE(comes_to(axis::AxisState::Ready)) << axis.fault_text();
    load(path);
  }

  void load(const trajectory::Path& path) {
    auto tail = axis_->encoder_at_rest(axis_->rest_position(), GoalTime{0.0})->encode(path);
    ASSERT_TRUE(tail) << tail.error().text;
    axis_->load(std::move(tail.value()), now());
    ASSERT_TRUE(comes_to(axis::AxisState::Loaded));
  }

  /// Deviation of a drive's demand from there() `time` s after its begin, counts.
  void compare(double demand, double time) {
    last_ = std::abs(demand - there().sample(GoalTime{time}).position * kCounts);
    worst_ = std::max(worst_, last_);
  }

  emulation::World world_;
  transport::VirtualCanBus& bus_ = world_.add_can_bus("can0", 1'000'000);
  hardware::CanLink link;
  axis::Axis* axis_ = nullptr;
  double worst_ = 0.0;
  double last_ = 0.0;
};

}  // namespace interpolated_motion::test
