#pragma once

#include <cmath>

#include <fmt/format.h>

#include "fuzz/support/foreign_node.h"
#include "fuzz/support/require.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::fuzz {

/// One emulated drive, and frames that are sent to it at times the input says. Whatever it was told, what it
/// says are frames, its demand is a number, and switched off and on it boots and answers again.
template <class Drive, class Parameters>
class CanDriveRun {
 public:
  explicit CanDriveRun(FuzzInput input)
      : input_(input),
        parameters_(quick_to_boot()),
        bus_(world_.add_can_bus("can0", 1'000'000)),
        drive_(world_.add<Drive>(bus_, parameters_)) {
    drive_.observe([](const emulation::DemandSample& sample) {
      require(std::isfinite(sample.demand), "the demand is no number");
    });
  }

  void operator()() {
    run(kBoot);
    for (int i = 0; i < kFrames && !input_.empty(); ++i) {
      const unsigned ticks = input_.byte();
      world_.can_bus("can0").send(read_frame(input_), world_.now());
      run(ticks * kTick);
    }
    // What the host has queued while the drive was away is not for the drive that boots.
    bus_.host_bus_off(world_.now());
    drive_.power_cycle(world_.now(), std::chrono::milliseconds(10));
    require_answer(2 * kBoot, 0x700U + parameters_.node_id, "it does not boot");
    const canopen::Frame request{0x600U + parameters_.node_id, false, false, 8, {0x40, 0x00, 0x10, 0x00}};
    world_.can_bus("can0").send(request, world_.now());
    require_answer(kBoot, 0x580U + parameters_.node_id, "it does not answer an SDO request");
  }

 private:
  static constexpr int kFrames = 500;
  static constexpr HostDuration kBootTime = std::chrono::milliseconds(5);
  static constexpr HostDuration kBoot = std::chrono::milliseconds(25);
  static constexpr HostDuration kTick = std::chrono::microseconds(100);

  static Parameters quick_to_boot() {
    Parameters parameters;
    parameters.boot_time = kBootTime;
    return parameters;
  }

  void run(HostDuration duration) {
    const HostTime end = world_.now() + duration;
    while (world_.now() < end) {
      world_.advance(end);
      while (const auto received = world_.can_bus("can0").receive()) take(*received);
    }
  }

  void take(const canopen::ReceivedFrame& received) {
    if (received.own) return;
    const canopen::Frame& frame = received.frame;
    require(frame.length <= 8 && (frame.extended || frame.id <= 0x7FF), "what it says is no frame");
    heard_ = heard_ || frame.id == awaited_;
  }

  void require_answer(HostDuration within, std::uint32_t id, const char* otherwise) {
    awaited_ = id;
    heard_ = false;
    run(within);
    require(heard_, fmt::format("{}: no frame {:X} within {} s", otherwise, id, seconds(within)));
  }

  FuzzInput input_;
  Parameters parameters_;
  emulation::World world_;
  transport::VirtualCanBus& bus_;
  Drive& drive_;
  std::uint32_t awaited_ = 0;
  bool heard_ = false;
};

}  // namespace interpolated_motion::fuzz
