#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "interpolated_motion_driver/commissioning/can_session.h"
#include "interpolated_motion_driver/commissioning/line_session.h"
#include "interpolated_motion_driver/commissioning/waiter.h"
#include "interpolated_motion_driver/emulation/world.h"

namespace interpolated_motion::commissioning {

/// Waits in virtual time.
class WorldWaiter : public Waiter {
 public:
  explicit WorldWaiter(emulation::World& world) : world_(world) {}

  HostTime now() const override { return world_.now(); }
  void wait(HostTime limit) override {
    world_.advance(std::min(limit, world_.now() + HostDuration(std::chrono::milliseconds(100))));
  }

 private:
  emulation::World& world_;
};

/// A CAN bus with emulated drives, and a session on it. All frames of the host are kept.
struct CanBench {
  CanBench() {
    // A drive boots in 0.2 s.
    bus.drop_if([this](const canopen::Frame& frame) {
      const bool of_host = (frame.id & 0x780U) == 0x600U;
      if (of_host) requests.push_back(frame);
      return false;
    });
  }

  emulation::World world;
  transport::VirtualCanBus& bus = world.add_can_bus("can0", 1'000'000);
  WorldWaiter waiter{world};
  CanSession session{world.can_bus("can0"), waiter, 1'000'000};
  std::vector<canopen::Frame> requests;  ///< SDO requests that were on the bus
};

/// A serial line with emulated drives, and a session on it. All requests of the host are kept.
struct LineBench {
  explicit LineBench(const transport::SerialLineParameters& line_parameters = {},
                     const silverlode::LineParameters& parameters = {})
      : line(world.add_serial_line("line0", line_parameters)),
        session(world.serial_line("line0"), waiter, "line0", parameters) {
    line.set_text_observer([this](transport::SerialDirection direction, std::string_view text, HostTime) {
      if (direction == transport::SerialDirection::HostToDrive) requests.emplace_back(text);
    });
  }

  emulation::World world;
  transport::VirtualSerialLine& line;
  WorldWaiter waiter{world};
  LineSession session;
  std::vector<std::string> requests;
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace interpolated_motion::commissioning
