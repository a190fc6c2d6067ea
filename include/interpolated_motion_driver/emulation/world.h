#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/emulation/device.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
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
///     auto& drive = world.add_epos(bus, parameters);
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

  /// A new drive on `bus`, switched on now: it sends its boot-up message after its boot time. Throws
  /// std::invalid_argument for a wrong parameter or a node id already taken on that bus. The reference stays
  /// valid.
  EposDrive& add_epos(transport::VirtualCanBus& bus, const EposParameters& parameters);

  /// The same for a drive in cyclic synchronous position mode.
  CyclicDrive& add_cyclic(transport::VirtualCanBus& bus, const CyclicParameters& parameters);

  /// A new serial line. Throws std::invalid_argument when the name is taken (by a line or a bus) or a
  /// parameter is out of range. The reference stays valid.
  transport::VirtualSerialLine& add_serial_line(std::string name,
                                                const transport::SerialLineParameters& parameters = {});

  /// A new drive on `line`. Two drives may have one address: their answers then spoil each other. Throws
  /// std::invalid_argument for a wrong parameter. The reference stays valid.
  SilverDust& add_silverdust(transport::VirtualSerialLine& line, const SilverDustParameters& parameters);

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
  struct Member {
    transport::VirtualCanBus* bus;
    std::uint8_t node_id;
    std::unique_ptr<Device> drive;
  };

  struct SerialMember {
    transport::VirtualSerialLine* line;
    std::unique_ptr<SilverDust> drive;
  };

  void require_free_name(const std::string& name) const;

  template <class Drive, class Parameters>
  Drive& add(transport::VirtualCanBus& bus, const Parameters& parameters);
  std::uint64_t delivered() const;
  void process_events();

  HostTime now_;
  std::vector<std::unique_ptr<transport::VirtualCanBus>> buses_;
  std::vector<Member> members_;
  std::vector<std::unique_ptr<transport::VirtualSerialLine>> lines_;
  std::vector<SerialMember> serial_members_;
};

}  // namespace interpolated_motion::emulation
