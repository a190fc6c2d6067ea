#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/transport/can_bus.h"
#include "interpolated_motion_driver/transport/serial_line.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// Emulated buses and drives in virtual time: a discrete-event scheduler. Deterministic: the same calls give
/// the same frames at the same nanoseconds.
///
///     World world;
///     auto& bus = world.add_can_bus("can0", 1'000'000);
///     auto& drive = world.add<EposDrive>(bus, parameters);
///     transport::CanBus& host = world.can_bus("can0");
///     while (now < end) {
///       while (auto frame = host.receive()) driver.on_frame(*frame);
///       host.send(..., now);
///       now = world.advance(std::min(end, driver.next_deadline()));
///     }
class World {
 public:
  /// An empty world at time `start`.
  explicit World(HostTime start = HostTime{});
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// A new bus. `bitrate` in bit/s, 10'000..1'000'000. Throws std::invalid_argument when the name is taken or
  /// the rate is out of range. The reference stays valid.
  transport::VirtualCanBus& add_can_bus(std::string name, int bitrate);

  /// A new drive on `bus`, switched on now. `DriveClass` is a Drive and is made of the bus, its parameters,
  /// which have a `node_id`, and the time. Throws std::invalid_argument for a wrong parameter or a node id
  /// already taken on that bus. The reference stays valid.
  template <class DriveClass, class Parameters>
  DriveClass& add(transport::VirtualCanBus& bus, const Parameters& parameters) {
    require_free_node(bus, parameters.node_id);
    auto drive = std::make_unique<DriveClass>(bus, parameters, now_);
    DriveClass& added = *drive;
    can_members_.push_back({&bus, parameters.node_id, std::move(drive)});
    return added;
  }

  /// A new serial line. Throws std::invalid_argument when the name is taken (by a line or a bus) or a
  /// parameter is out of range. The reference stays valid.
  transport::VirtualSerialLine& add_serial_line(std::string name,
                                                const transport::SerialLineParameters& parameters = {});

  /// The same on a serial line. Two drives may have one address: their answers then spoil each other.
  template <class DriveClass, class Parameters>
  DriveClass& add(transport::VirtualSerialLine& line, const Parameters& parameters) {
    auto drive = std::make_unique<DriveClass>(line, parameters, now_);
    DriveClass& added = *drive;
    line_members_.push_back(std::move(drive));
    return added;
  }

  /// The host's side of a line. Throws std::invalid_argument when there is no line of that name.
  transport::SerialLine& serial_line(std::string_view name);

  /// The host's side of a bus. Throws std::invalid_argument when there is no bus of that name.
  transport::CanBus& can_bus(std::string_view name);

  /// Runs buses and drives up to `limit`, or only up to the instant at which a frame (of a drive, or the echo
  /// of one of the host) becomes available to the host, or a line of text does: on a serial line the host is
  /// woken at a CR and when the line goes idle, not at each character, but each has its own time. Returns
  /// that time, which is now() from then on. What the host left unread earlier does not end a call. Frames
  /// and text sent with a time stamp ahead of now() leave at that time.
  HostTime advance(HostTime limit);

  /// Virtual time up to which everything has been computed.
  HostTime now() const { return now_; }

  /// Time of the next thing that a bus or a drive does by itself, kNever when there is none.
  HostTime next_event() const;

 private:
  struct CanMember {
    transport::VirtualCanBus* bus;  ///< of the world
    int node_id;                    ///< 1..127, no other on this bus
    std::unique_ptr<Drive> drive;   ///< never null
  };

  void require_free_name(const std::string& name) const;
  void require_free_node(const transport::VirtualCanBus& bus, int node_id) const;
  std::uint64_t delivered() const;
  void process_events();

  HostTime now_;
  std::vector<std::unique_ptr<transport::VirtualCanBus>> buses_;
  std::vector<CanMember> can_members_;
  std::vector<std::unique_ptr<transport::VirtualSerialLine>> lines_;
  std::vector<std::unique_ptr<Drive>> line_members_;
};

}  // namespace interpolated_motion::emulation
